// The overrides, the spindle and the coolant.
import { signal } from '@preact/signals';
import { say } from '../core/language';
import { whyUnable } from '../machine/abilities';
import { moveAs, whyNot } from '../machine/actions';
import type { SpindleDrive, Status } from '../machine/api';
import { status } from '../machine/connection';
import { Button } from './button';

type Factor = 'feed' | 'rapids' | 'spindle';
// A board that plans its own motion has bounds of its own.
const boardBounds: Record<Factor, { least: number; most: number; step: number }> = {
  feed: { least: 10, most: 200, step: 10 },
  rapids: { least: 25, most: 100, step: 25 },
  spindle: { least: 10, most: 200, step: 10 },
};
const boundsOf = (factor: Factor) => (whyUnable('any-override') === '' ? bounds : boardBounds)[factor];
const bounds: Record<Factor, { least: number; most: number; step: number }> = {
  feed: { least: 0, most: 200, step: 10 },
  rapids: { least: 5, most: 100, step: 25 },
  spindle: { least: 0, most: 200, step: 10 },
};
// What was asked for, until the daemon tells it: fast presses count one upon the other.
const wanted = signal<Partial<Record<Factor, number>>>({});
let settle: ReturnType<typeof setTimeout> | undefined;
// One request after the other: two that are under way together may arrive in the other order.
let sent: Promise<unknown> = Promise.resolve();

const percentOf = (now: Status, factor: Factor): number => wanted.value[factor] ?? Math.round(now.overrides[factor] * 100);

function set(factor: Factor, percent: number): void {
  const { least, most } = boundsOf(factor);
  const bounded = Math.min(most, Math.max(least, percent));
  wanted.value = { ...wanted.value, [factor]: bounded };
  clearTimeout(settle);
  const last = sent.then(() => moveAs('/override', { [factor]: bounded / 100 }));
  sent = last;
  void last.then(() => {
    if (sent === last) settle = setTimeout(() => (wanted.value = {}), 800);
  });
}

const anyState = ['Offline', 'Idle', 'Run', 'Hold', 'Jog', 'Home', 'Probe', 'Tool', 'Line', 'Check', 'Door', 'Sleep'];

function Override({ factor }: { factor: Factor }) {
  const now = status.value;
  if (now === null) return null;
  const name = say(`run.${factor}`);
  const percent = percentOf(now, factor);
  const { most, step } = boundsOf(factor);
  const why = whyNot(...anyState);
  return (
    <div class="override" role="group" aria-label={name}>
      <span class="override-name">{name}</span>
      <Button icon="minus" why={why} label={say('run.less', { name })} onClick={() => set(factor, percent - step)} />
      <button
        type="button"
        class={`override-value ${percent === 100 ? '' : 'changed'}`}
        title={say('run.usual')}
        aria-label={`${name} ${percent} %. ${say('run.usual')}`}
        aria-disabled={why !== ''}
        onClick={() => why === '' && set(factor, 100)}
      >
        <b class="figure">{percent}</b> %
        <i style={{ width: `${(percent / most) * 100}%` }} />
      </button>
      <Button icon="plus" why={why} label={say('run.more', { name })} onClick={() => set(factor, percent + step)} />
    </div>
  );
}

// Where programs wait for a person.
function Stop({ name, on }: { name: keyof Status['stops']; on: boolean }) {
  const unable = name === 'single_block' ? whyUnable('single-block') : '';
  return (
    <Button pressed={on} why={unable || whyNot(...anyState)} onClick={() => moveAs('/stops', { [name]: !on })}>
      {say(`run.stops.${name}`)}
    </Button>
  );
}

// What the spindle's drive reports: its true speed, current and load.
function MeasuredSpindle({ drive }: { drive: SpindleDrive }) {
  if (!drive.answers) return <span class="spindle-measured silent">{say('run.spindle.silent')}</span>;
  return (
    <span class="spindle-measured">
      <span class="dim">{say('run.spindle.measured')}</span> <span class="figure">{Math.round(drive.speed)}</span> {say('run.rpm')}
      {drive.current !== null && (
        <span>
          {' · '}
          <span class="figure">{drive.current.toFixed(1)}</span> A
        </span>
      )}
      {drive.load !== null && (
        <span>
          {' · '}
          <span class="dim">{say('run.spindle.load')}</span> <span class="figure">{Math.round(drive.load * 100)}</span> %
        </span>
      )}
    </span>
  );
}

export function Overrides() {
  const now = status.value;
  if (now === null) return null;
  const { outputs, stops } = now;
  const whyOutputs = whyNot('Run', 'Hold', 'Tool', 'Line', 'Door');
  return (
    <section class="panel overrides" aria-label={say('run.overrides')}>
      <h2>{say('run.overrides')}</h2>
      <Override factor="feed" />
      <Override factor="rapids" />
      <Override factor="spindle" />
      <div class="spindle">
        <span class={`spindle-state ${outputs.spindle === 'off' ? '' : 'turns'}`}>
          <span class="dim">{say('run.spindle')}</span> <b>{say(`run.spindle.${outputs.spindle}`)}</b>
          {outputs.spindle !== 'off' && (
            <span>
              {' '}
              <span class="figure">{Math.round(outputs.spindle_speed * now.overrides.spindle)}</span> {say('run.rpm')}
            </span>
          )}
        </span>
        {now.spindle_drive && <MeasuredSpindle drive={now.spindle_drive} />}
        <Button pressed={outputs.flood} why={whyOutputs} onClick={() => moveAs('/outputs', { flood: !outputs.flood })}>
          {say('run.flood')}
        </Button>
        <Button pressed={outputs.mist} why={whyOutputs} onClick={() => moveAs('/outputs', { mist: !outputs.mist })}>
          {say('run.mist')}
        </Button>
      </div>
      <div class="stops">
        <Stop name="single_block" on={stops.single_block} />
        <Stop name="optional_stop" on={stops.optional_stop} />
      </div>
    </section>
  );
}
