// Start or go on, hold, stop: always at the same places, on each page.
import { say } from '../core/language';
import { done, hold, reset, resume, start, stop, wake, whyNoDone, whyNoHold, whyNoResume, whyNoStart, whyNoStop, whyNot } from '../machine/actions';
import { isLive, status } from '../machine/connection';
import { axes, workPlace } from '../machine/place';
import { isAtWait, waits } from '../machine/waits';
import { isHeldIdle } from '../machine/words';
import { path } from '../core/route';
import { placeText } from '../core/units';
import { Button } from './button';

function GoButton() {
  const now = status.value;
  // Also while the machine is jogged or probed meanwhile.
  const goesOn = waits.value.now !== null && now !== null && !['Hold', 'Door', 'Alarm', 'Fault', 'Sleep'].includes(now.state);
  if (now !== null && (goesOn || isAtWait(now))) {
    return <Button class="act" kind="go" icon="done" why={whyNoDone.value} onClick={done} children={say('do.done')} />;
  }
  if (now !== null && isHeldIdle(now)) {
    return <Button class="act" kind="go" icon="resume" why={whyNot('Idle')} onClick={resume} children={say('do.resume')} />;
  }
  switch (now?.state) {
    case 'Hold':
    case 'Door':
      return <Button class="act" kind="go" icon="resume" why={whyNoResume.value} onClick={resume} children={say('do.resume')} />;
    case 'Alarm':
    case 'Fault':
      return <Button class="act" kind="go" icon="reset" why={whyNot('Alarm', 'Fault')} onClick={reset} children={say('do.reset')} />;
    case 'Sleep':
      return <Button class="act" kind="go" icon="run" why={whyNot('Sleep')} onClick={wake} children={say('do.wake')} />;
    default:
      return <Button class="act" kind="go" icon="run" why={whyNoStart.value} onClick={start} children={say('do.start')} />;
  }
}

function SmallPosition() {
  if (path.value === 'run' || path.value === 'jog') return null;
  return (
    <dl class={`small-position ${isLive.value ? '' : 'old'}`}>
      {axes.value.map((axis) => (
        <div key={axis}>
          <dt>{axis.toUpperCase()}</dt>
          <dd>{placeText(axis, workPlace.value[axis] ?? 0)}</dd>
        </div>
      ))}
    </dl>
  );
}

export function ActionBar() {
  return (
    <section class="actions" aria-label={say('frame.actions')}>
      <SmallPosition />
      <GoButton />
      <Button class="act" kind="hold" icon="hold" why={whyNoHold.value} onClick={hold} children={say('do.hold')} />
      <Button class="act" kind="stop" icon="stop" why={whyNoStop.value} onClick={stop} children={say('do.stop')} />
    </section>
  );
}
