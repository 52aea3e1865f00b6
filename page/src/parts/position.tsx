// The position: big in work coordinates, small in the machine's.
import { say } from '../core/language';
import { lengthUnit, placeText, speedText, speedUnit } from '../core/units';
import { canHome } from '../machine/abilities';
import { status } from '../machine/connection';
import { axes, machinePlace, workPlace, workRotation } from '../machine/place';
import { Icon } from './icon';

// The machine has switches, and has not been homed by them.
const isDoubtful = (): boolean => status.value !== null && status.value.trust !== 'homed' && canHome.value;

export function Position() {
  const trust = status.value?.trust ?? 'unknown';
  const measured = status.value?.measured_tool;
  return (
    <section class="panel position" aria-label={say('run.position')}>
      <div class="position-head">
        <h2>
          {say('run.work')} <span class="unit">{lengthUnit()}</span>
        </h2>
        {workRotation.value !== 0 && (
          <span class="turned" data-testid="work-rotation" title={say('run.turned.help')}>
            <Icon name="turned" /> {say('run.turned', { degrees: String(Number(workRotation.value.toFixed(2))) })}
          </span>
        )}
        <span class="unit">{say('run.machine')}</span>
      </div>
      <div class={`axes ${trust === 'unknown' ? 'unsure' : ''}`} title={trust === 'unknown' ? say('run.trust.unknown') : undefined}>
        {axes.value.map((axis) => (
          <div class="axis" key={axis} data-axis={axis}>
            <span class="axis-name">{axis.toUpperCase()}</span>
            <span class="digits" data-testid={`work-${axis}`}>
              {placeText(axis, workPlace.value[axis] ?? 0)}
            </span>
            <span class="axis-machine">
              <span class="unseen">{say('run.machine')}: </span>
              {placeText(axis, machinePlace.value[axis] ?? 0)}
            </span>
          </div>
        ))}
      </div>
      <div class="position-foot">
        <span>
          <span class="dim">{say('run.speed')}</span> <b class="figure">{speedText(status.value?.speed ?? 0)}</b>{' '}
          <span class="unit">{speedUnit()}</span>
        </span>
        {measured != null && (
          <span class="measured" data-testid="measured-tool">
            <span class="dim">{say('run.tool', { tool: measured.tool })}</span> <b class="figure">{placeText('z', measured.length)}</b>{' '}
            <span class="unit">{lengthUnit()}</span>
          </span>
        )}
        <span class={`trust ${trust === 'homed' ? 'sure' : isDoubtful() ? 'doubt' : ''}`}>
          <Icon name={trust === 'homed' ? 'home' : 'warn'} />
          {say(`run.trust.${trust}`)}
        </span>
      </div>
    </section>
  );
}
