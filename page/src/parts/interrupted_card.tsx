// The job that was broken off, with all facts on one card; and a line that leads to it from the other pages.
import { reportWords } from '../core/faults';
import { language, say } from '../core/language';
import { path, goTo } from '../core/route';
import { momentText } from '../core/time';
import { whyNot } from '../machine/actions';
import { advice, adviceWords } from '../machine/advice';
import { status } from '../machine/connection';
import { interrupted, stepsOf } from '../machine/interrupted';
import { machinePlace, placeWords } from '../machine/place';
import { home } from '../machine/set_up';
import { dropInterrupted, reenterInterrupted, resumeInterrupted } from '../machine/way_back';
import { Button } from './button';
import { Icon } from './icon';
import { Steps } from './reported';

export function InterruptedBanner() {
  const broken = interrupted.value;
  if (broken === null || path.value === 'run') return null;
  return (
    <div class="owner" role="status">
      <span>{say('broken.banner', { name: broken.job.name })}</span>
      <Button onClick={() => goTo('run')}>{say('broken.look')}</Button>
    </div>
  );
}

export function InterruptedCard() {
  const broken = interrupted.value;
  if (broken === null) return null;
  const { reentry } = broken;
  const why = whyNot('Idle');
  const next = advice.value;
  const place = broken.place ?? reentry.place;
  return (
    <section class="panel broken" aria-label={say('broken.title')}>
      <h2 class="title">
        <Icon name="warn" /> {say('broken.title')}: {broken.job.name}
      </h2>
      <table class="facts">
        <tbody>
          <Fact name={say('broken.begun')} words={momentText(broken.job.begun_at, language.value)} />
          <Fact name={say('broken.noted')} words={momentText(broken.noted_at, language.value)} />
          <Fact
            name={say('broken.where')}
            words={`${say('run.line', { line: broken.line ?? reentry.line ?? '?' })}${place === null ? '' : `, ${placeWords(place)} (${say('run.machine')})`}`}
          />
          <Fact
            name={say('broken.stands')}
            words={status.value === null || status.value.trust === 'unknown' ? say('run.trust.unknown') : `${placeWords(machinePlace.value)} (${say('run.machine')})`}
          />
          {broken.job.why !== '' && <Fact name={say('broken.why')} words={reportWords(broken.job.why, broken.job.why_sentence)} />}
          <Fact name={say('broken.goes')} words={broken.goes_on ? say('broken.goes.exactly') : `${reportWords(broken.why, broken.why_sentence)}.`} code={broken.code} />
          {!broken.goes_on && reentry.code !== '' && <Fact name={say('broken.back')} words={`${reportWords(reentry.why, reentry.why_sentence)}.`} code={reentry.code} />}
        </tbody>
      </table>
      {reentry.steps.length > 0 && (
        <details open={!broken.goes_on}>
          <summary>{say('broken.back.steps')}</summary>
          <Steps steps={stepsOf(reentry)} />
        </details>
      )}
      <div class="row">
        {broken.goes_on && (
          <Button kind="go" icon="resume" why={why} onClick={() => resumeInterrupted(broken)}>
            {say('broken.resume')}
          </Button>
        )}
        {next === 'home' && (
          <Button kind="accent" icon="home" why={why} onClick={home}>
            {say('jog.home')}
          </Button>
        )}
        <Button
          kind={next === 'reenter' ? 'go' : 'plain'}
          icon="resume"
          why={why !== '' ? why : reportWords(reentry.why, reentry.why_sentence)}
          onClick={() => reenterInterrupted(broken)}
        >
          {say('broken.reenter')}
        </Button>
        <Button kind={next === 'drop' ? 'accent' : 'plain'} icon="trash" why={why} onClick={() => dropInterrupted(broken)}>
          {say('broken.drop')}
        </Button>
      </div>
      <p>
        <b>{adviceWords.value}</b> <span class="dim">{say('broken.nothing')}</span>
      </p>
    </section>
  );
}

function Fact({ name, words, code = '' }: { name: string; words: string; code?: string }) {
  return (
    <tr>
      <th scope="row">{name}</th>
      <td>
        {words} {code !== '' && <code class="dim">{code}</code>}
      </td>
    </tr>
  );
}
