// Whether the motors have the torque for a program, with the worst lines.
import { useEffect } from 'preact/hooks';
import { language, say } from '../core/language';
import { goTo } from '../core/route';
import { fromMm, lengthUnit } from '../core/units';
import type { Program } from '../machine/api';
import { loadsOfShown, wantLoads, type LoadedLine, type MotorLoads, type Verdict } from '../machine/studies';
import { tells } from '../scene/colouring';
import { picked } from '../scene/stage';
import { Button } from './button';
import { Icon, type IconName } from './icon';

export const verdictIcons: Record<Verdict, IconName> = { safe: 'calm', doubtful: 'warn', lost: 'bad' };
const mostShown = 6;
const percent = (share: number): string => `${Math.round(share * 100)} %`;

// Where the torque is enough and steps are lost all the same, a motor swings.
export function verdictOf({ verdict, most }: Pick<MotorLoads, 'verdict' | 'most'>): string {
  const contradicts = verdict === 'safe' ? most > 1 : most <= 1;
  return say(contradicts ? `torque.${verdict}.swing` : `torque.${verdict}`, { share: percent(most) });
}

// Limits to keep below: rounded down to three digits.
function below(value: number): number {
  const unit = 10 ** (Math.floor(Math.log10(Math.max(value, 1e-9))) - 2);
  return Number((Math.floor(value / unit + 1e-9) * unit).toPrecision(6));
}
function cureOf(one: LoadedLine): string {
  const turns = 'ABC'.includes(one.axis.toUpperCase());
  const shown = (value: number): number => below(turns ? value : fromMm(value));
  const unit = turns ? '°' : lengthUnit();
  const cures: string[] = [];
  if (one.safe_acceleration !== undefined) cures.push(say('torque.cure.acceleration', { value: `${shown(one.safe_acceleration)} ${unit}/s²` }));
  if (one.safe_velocity_mm_min !== undefined) cures.push(say('torque.cure.velocity', { value: `${shown(one.safe_velocity_mm_min)} ${unit}/min` }));
  else if (one.safe_feed_mm_min !== undefined) cures.push(say('torque.cure.feed', { value: `${shown(one.safe_feed_mm_min)} ${unit}/min` }));
  return say('torque.cure', { cures: cures.length === 0 ? say('torque.cure.motor') : cures.join(say('torque.cure.or')) });
}

export function WorstLines({ worst, pick }: { worst: readonly LoadedLine[]; pick: (line: number) => void }) {
  return (
    <ul class="findings">
      {worst.slice(0, mostShown).map((one) => (
        <li key={`${one.line} ${one.axis}`} class={one.verdict === 'safe' ? '' : one.verdict === 'lost' ? 'error' : 'warning'}>
          <button type="button" class="finding" onClick={() => pick(one.line)}>
            <Icon name={verdictIcons[one.verdict]} />
            <span>
              <b>{say('run.line', { line: one.line })}</b>{' '}
              {say(`torque.line.${one.want}`, {
                axis: one.axis,
                needed: one.needed_nm.toFixed(2),
                there: one.low_nm.toFixed(2),
                rate: Math.round(one.full_steps_s).toLocaleString(language.value),
              })}{' '}
              {one.verdict !== 'safe' && <span class="dim">{cureOf(one)}</span>}
            </span>
          </button>
        </li>
      ))}
    </ul>
  );
}

export function MotorLoad({ program }: { program: Program }) {
  useEffect(wantLoads, []);
  const loads = loadsOfShown.value;
  if (program.state !== 'good') return null;
  return (
    <>
      <h2 class="findings-title">{say('torque.title')}</h2>
      <p role="status" data-testid="torque" class={loads?.state === 'done' ? `verdict ${loads.verdict === 'lost' ? 'bad' : 'good'}` : 'dim'}>
        {loads?.state === 'done' && <Icon name={verdictIcons[loads.verdict]} />}{' '}
        {loads === null || loads.state === 'running'
          ? say('torque.running')
          : loads.state === 'done'
            ? verdictOf(loads)
            : say(`torque.${loads.state}`, { why: loads.words })}
      </p>
      {loads?.state === 'done' && (
        <>
          <WorstLines
            worst={loads.worst}
            pick={(line) => {
              picked.value = line;
              goTo('run');
            }}
          />
          <Button
            icon="run"
            onClick={() => {
              tells.value = 'torque';
              goTo('run');
            }}
          >
            {say('torque.show')}
          </Button>
        </>
      )}
    </>
  );
}
