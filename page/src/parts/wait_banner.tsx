// Where the program waits: what it says there, in its own words, and what a person can do.
import { say } from '../core/language';
import { goTo, path } from '../core/route';
import { done, whyNoDone } from '../machine/actions';
import { isFree, waits, wordsOfWait } from '../machine/waits';
import { Button } from './button';

export function WaitBanner() {
  const { now } = waits.value;
  if (now === null) return null;
  return (
    <section class="owner waits" aria-label={say('state.Tool')}>
      <div role="status">
        <b>{wordsOfWait(now)}</b>
        {now.message !== '' && <p class="program-words">{now.message}</p>}
        <p class="dim">{say(isFree.value ? 'wait.free' : 'wait.outputs')}</p>
      </div>
      <div class="row">
        {path.value !== 'jog' && (
          <Button icon="jog" onClick={() => goTo('jog')}>
            {say('page.jog')}
          </Button>
        )}
        <Button kind="go" icon="done" why={whyNoDone.value} onClick={done}>
          {say('do.done')}
        </Button>
      </div>
    </section>
  );
}
