// The method as a few lines of code: those that the present pulse ran through are marked, with the axes that stepped.
import type { JSX } from 'preact';
import type { Interpolation } from '../core';
import { axisNames } from '../view';
import { say } from '../words';

interface Line {
  code: string;
  runs: 'start' | 'each' | 'step' | 'x' | 'y' | 'both' | 'along'; // when
  shows?: string; // columns of the pulse, e.g. "sum" for sum_x and sum_y
}

const stepOf = (take: string, test: string): Line[] => [
  { code: `    if ${test}`, runs: 'each' },
  { code: '      step j', runs: 'step' },
  { code: `      ${take}`, runs: 'step' },
];
const loop: Line[] = [
  { code: 'for k = 1 … Δm', runs: 'each' },
  { code: '  for each j', runs: 'each' },
];
const comparison = (end: string): Line[] => [
  { code: 'F = 0', runs: 'start' },
  { code: `while ${end}`, runs: 'each' },
  { code: '  if F ≥ 0', runs: 'each', shows: 'judge' },
  { code: '    step x;  F −= |ye|', runs: 'x' },
  { code: '  else', runs: 'y' },
  { code: '    step y;  F += |xe|', runs: 'y' },
];
const listings: Partial<Record<string, Line[]>> = {
  'master-slave': [
    ...loop,
    { code: '    if 2·k·Δ[j] ≥ (2·p[j] + 1)·Δm', runs: 'each', shows: 'ideal' },
    { code: '      step j;  p[j] += 1', runs: 'step' },
  ],
  lean: [
    { code: 'for each j:  d[j] = −Δm', runs: 'start' },
    ...loop,
    { code: '    d[j] += 2·Δ[j]', runs: 'each', shows: 'sum' },
    ...stepOf('d[j] −= 2·Δm', 'd[j] ≥ 0'),
  ],
  dda: [
    { code: 'for each j:  A[j] = 0  (2^N / 2)', runs: 'start' },
    { code: 'for k = 1 … 2^N', runs: 'each' },
    { code: '  for each j', runs: 'each' },
    { code: '    A[j] += Δ[j]', runs: 'each', shows: 'sum' },
    ...stepOf('A[j] −= 2^N', 'A[j] ≥ 2^N'),
  ],
  'slope-recalculated': [
    { code: 'm = Δy / Δx', runs: 'start' },
    { code: 'for k = 1 … Δx', runs: 'each' },
    { code: '  if (ye − y)/(xe − x) ≥ m  and k > 1', runs: 'each', shows: 'slope_left' },
    { code: '    step x, y', runs: 'both' },
    { code: '  else', runs: 'along' },
    { code: '    step x', runs: 'along' },
  ],
  'point-comparison': comparison('n[x] + n[y] > 0'),
  'listing:rounding': [
    ...loop,
    { code: '    q = round((Δ[j] / Δm)·k)', runs: 'each', shows: 'ideal' },
    { code: '    if q ≠ p[j]', runs: 'each' },
    { code: '      step j;  p[j] = q', runs: 'step' },
  ],
  'listing:shared-variable': [
    { code: 'd = +Δm', runs: 'start' },
    ...loop,
    { code: '    d += 2·Δ[j]', runs: 'each', shows: 'sum' },
    ...stepOf('d −= 2·Δm', 'd ≥ 0'),
  ],
  'listing:projection': comparison('n > 0'),
};
export const hasCode = (answer: Interpolation): boolean => listings[answer.name] !== undefined;

export function CodeView({ answer, beat }: { answer: Interpolation; beat: number }): JSX.Element | null {
  const lines = listings[answer.name];
  if (!lines) return null;
  const steps = beat > 0 ? (answer.steps[beat - 1] ?? 0) : 0;
  const stepped = axisNames.filter((_, axis) => ((steps >> axis) & 1) === 1).map((name) => name.toUpperCase());
  const ran = ({ runs }: Line): boolean => {
    if (beat === 0) return runs === 'start';
    if (runs === 'step') return steps !== 0;
    if (runs === 'x' || runs === 'y') return steps === (runs === 'x' ? 1 : 2);
    if (runs === 'both' || runs === 'along') return (steps === 3) === (runs === 'both');
    return runs === 'each';
  };
  const note = (line: Line): string => {
    if (beat === 0 || !ran(line)) return '';
    if (line.shows !== undefined) return shown(answer, line.shows, beat);
    return line.runs === 'each' || line.runs === 'start' || !line.code.includes('step') ? '' : stepped.join(' ');
  };
  return (
    <ol class="lab-code" aria-label={say('codeTitle')}>
      {lines.map((line, i) => (
        <li key={i} class={ran(line) ? 'lab-ran' : ''} aria-current={ran(line) ? 'step' : undefined}>
          <code>{line.code}</code>
          <span>{note(line)}</span>
        </li>
      ))}
    </ol>
  );
}

// What the line computed in this pulse: "X 10, Y −2".
function shown(answer: Interpolation, column: string, beat: number): string {
  return Object.entries(answer.judge)
    .filter(([name]) => name === column || (name.startsWith(`${column}_`) && name.length === column.length + 2))
    .map(([name, cells]) => {
      const axis = name === column ? '' : `${name.slice(-1).toUpperCase()} `;
      return axis + (cells[beat - 1] ?? '').replace('>=', ' ≥ ').replace('<', ' < ').replaceAll('-', '−');
    })
    .join(', ');
}

// Point comparison in all quadrants: which way the axes are fed. The row of the present line is marked.
export function Quadrants({ end }: { end: readonly [number, number] }): JSX.Element {
  const here = end[0] >= 0 ? (end[1] >= 0 ? 0 : 3) : end[1] >= 0 ? 1 : 2;
  const rows = [['+', '+'], ['−', '+'], ['−', '−'], ['+', '−']] as const;
  return (
    <div class="lab-table-frame">
      <table class="lab-quadrants">
        <thead>
          <tr>
            <th>{say('quadrant')}</th>
            <th>xe, ye</th>
            <th>F ≥ 0</th>
            <th>F &lt; 0</th>
          </tr>
        </thead>
        <tbody>
          {rows.map(([x, y], i) => (
            <tr key={i} class={i === here ? 'lab-present' : ''} aria-current={i === here ? 'true' : undefined}>
              <td>{i + 1}</td>
              <td>{`${x} ${y}`}</td>
              <td class="lab-feed">{`${x}X`}</td>
              <td class="lab-feed">{`${y}Y`}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
