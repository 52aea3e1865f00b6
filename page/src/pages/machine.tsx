// The machine: what its file says, and its inputs now; and, as a part of its own, its board.
import { say, type Key } from '../core/language';
import { query } from '../core/route';
import { isRotary, lengthText, lengthUnit, perLength, placeText, smallUnit, speedText, speedUnit } from '../core/units';
import type { MachineAxis } from '../machine/api';
import { machine, status } from '../machine/connection';
import { RowHead } from '../parts/row_head';
import { Tuning } from '../parts/tuning';
import { BoardPart } from './board';
import { MachineEditor } from './machine_editor';
import { ToolsPart } from './machine_tools';

const columns: readonly [Key, (axis: MachineAxis) => string, (() => string)?][] = [
  ['machine.from', (axis) => placeText(axis.axis, axis.low), lengthUnit],
  ['machine.to', (axis) => placeText(axis.axis, axis.high), lengthUnit],
  ['machine.travel', (axis) => placeText(axis.axis, axis.high - axis.low), lengthUnit],
  ['machine.speed', (axis) => speedText(axis.speed), speedUnit],
  ['machine.acceleration', (axis) => lengthText(axis.acceleration ?? 0, 1), () => `${lengthUnit()}/s²`],
  ['machine.steps', (axis) => stepsText(axis), () => `1/${lengthUnit()}`],
  ['machine.step', (axis) => stepText(axis), smallUnit],
  ['machine.homes', (axis) => say(axis.homes ? 'machine.homes.yes' : 'machine.homes.no')],
];

const stepsText = ({ axis, steps_per_unit: steps }: MachineAxis): string =>
  steps === undefined ? '' : String(Number((isRotary(axis) ? steps : perLength(steps)).toPrecision(9)));
// Thousandths of a unit: of a millimetre, an inch, a degree.
const stepText = ({ axis, steps_per_unit: steps }: MachineAxis): string =>
  steps === undefined ? '' : isRotary(axis) ? (1000 / steps).toFixed(1) : (1000 / perLength(steps)).toFixed(2);

const parts: readonly [string, Key][] = [
  ['machine', 'page.machine'],
  ['machine?part=board', 'board.title'],
  ['machine?part=tools', 'toollife.title'],
];

export function MachinePage() {
  const shown = parts.findIndex(([path]) => path === `machine?part=${query.value.get('part')}`);
  return (
    <div class="machine">
      <nav class="machine-parts" aria-label={say('page.machine')}>
        {parts.map(([path, title], i) => (
          <a key={path} href={`#/${path}`} aria-current={Math.max(0, shown) === i ? 'page' : undefined}>
            {say(title)}
          </a>
        ))}
      </nav>
      {shown === 1 ? <BoardPart /> : shown === 2 ? <ToolsPart /> : <MachinePart />}
    </div>
  );
}

function MachinePart() {
  const known = machine.value;
  if (known === null) return <p class="dim">{say('frame.loading')}</p>;
  const inputs = status.value?.inputs;
  return (
    <>
      <section class="panel" aria-label={say('machine.title')}>
        <h2 class="title">{known.name}</h2>
        <p class="dim">{say('machine.version', { version: known.version })}</p>
        <div class="wide-table" tabIndex={0} role="region" aria-label={known.name}>
          <table>
            <thead>
              <tr>
                <th scope="col">{say('machine.axis')}</th>
                {known.axes.map((axis) => (
                  <th scope="col" key={axis.axis} class="axis-head" data-axis={axis.axis}>
                    {axis.axis.toUpperCase()}
                  </th>
                ))}
              </tr>
            </thead>
            <tbody>
              {columns.map(([title, text, unit]) => (
                <tr key={title}>
                  <RowHead title={say(title)} unit={unit?.() ?? ''} />
                  {known.axes.map((axis) => (
                    <td key={axis.axis}>{text(axis)}</td>
                  ))}
                </tr>
              ))}
            </tbody>
          </table>
        </div>
        <p class="dim">{say('machine.file')}</p>
      </section>
      <MachineEditor />
      <Tuning />
      {inputs !== undefined && (
        <section class="panel" aria-label={say('machine.inputs')}>
          <h2>{say('machine.inputs')}</h2>
          <ul class="inputs">
            {(['probe', 'door', 'hold'] as const).map((one) => (
              <li key={one} class={inputs[one] ? 'closed' : ''}>
                <i aria-hidden="true" />
                {say(`machine.input.${one}`)} <b>{say(inputs[one] ? 'machine.closed' : 'machine.open')}</b>
              </li>
            ))}
          </ul>
        </section>
      )}
    </>
  );
}
