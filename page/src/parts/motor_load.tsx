// Whether the motors have the torque for a program, with the worst lines.
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { goTo } from '../core/route';
import type { Program } from '../machine/api';
import { loadsOfShown, wantLoads, type Verdict } from '../machine/studies';
import { tells } from '../scene/colouring';
import { picked } from '../scene/stage';
import { Button } from './button';
import { Icon, type IconName } from './icon';

const icons: Record<Verdict, IconName> = { safe: 'calm', doubtful: 'warn', lost: 'bad' };
const mostShown = 6;
const percent = (share: number): string => `${Math.round(share * 100)} %`;

export function MotorLoad({ program }: { program: Program }) {
  useEffect(wantLoads, []);
  const loads = loadsOfShown.value;
  if (program.state !== 'good') return null;
  return (
    <>
      <h2 class="findings-title">{say('torque.title')}</h2>
      <p role="status" data-testid="torque" class={loads?.state === 'done' ? `verdict ${loads.verdict === 'lost' ? 'bad' : 'good'}` : 'dim'}>
        {loads?.state === 'done' && <Icon name={icons[loads.verdict]} />}{' '}
        {loads === null || loads.state === 'running'
          ? say('torque.running')
          : loads.state === 'done'
            ? say(`torque.${loads.verdict}`, { share: percent(loads.most) })
            : say(`torque.${loads.state}`, { why: loads.words })}
      </p>
      {loads?.state === 'done' && (
        <>
          <ul class="findings">
            {loads.worst.slice(0, mostShown).map((one) => (
              <li key={`${one.line} ${one.axis}`} class={one.verdict === 'safe' ? '' : one.verdict === 'lost' ? 'error' : 'warning'}>
                <button
                  type="button"
                  class="finding"
                  onClick={() => {
                    picked.value = one.line;
                    goTo('run');
                  }}
                >
                  <Icon name={icons[one.verdict]} />
                  <span>
                    <b>{say('run.line', { line: one.line })}</b>{' '}
                    {say('torque.line', { axis: one.axis, needed: one.needed_nm.toFixed(2), there: one.low_nm.toFixed(2) })}{' '}
                    <span class="dim" lang="en">
                      {one.cause} {one.cure ?? ''}
                    </span>
                  </span>
                </button>
              </li>
            ))}
          </ul>
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
