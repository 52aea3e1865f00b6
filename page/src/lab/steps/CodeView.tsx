// The method as a few lines of code: those that the present pulse ran through are marked, with the axes that stepped.
import type { JSX } from 'preact';
import type { Interpolation } from '../core';
import { axisNames, codeOf, type MethodCode } from '../view';
import { say } from '../words';

interface Line {
  code: string;
  runs: 'start' | 'each' | 'step' | 'x' | 'y' | 'both' | 'along'; // when
  shows?: string; // columns of the pulse, e.g. "sum" for sum_x and sum_y
}

const stepOf = (test: string, take: string): Line[] => [
  { code: `    if (${test}) {`, runs: 'each' },
  { code: '      ++p[j];', runs: 'step' },
  { code: `      ${take};`, runs: 'step' },
];
const loop = (pulses: string): Line[] => [
  { code: `for (k = 1; k <= ${pulses}; ++k)`, runs: 'each' },
  { code: '  for (j = 0; j < n; ++j) {', runs: 'each' },
];
const comparison = (left: string): Line[] => [
  { code: 'f = 0;', runs: 'start' },
  { code: `while (${left} > 0)`, runs: 'each' },
  { code: '  if (f >= 0)', runs: 'each', shows: 'judge' },
  { code: '    ++x, f -= ye;', runs: 'x' },
  { code: '  else', runs: 'y' },
  { code: '    ++y, f += xe;', runs: 'y' },
];
const integration = (start: string): Line[] => [
  { code: `a[j] = ${start};`, runs: 'start' },
  ...loop('1 << bits'),
  { code: '    a[j] += s[j];', runs: 'each', shows: 'sum' },
  ...stepOf('a[j] >= 1 << bits', 'a[j] -= 1 << bits'),
];
// In C, as the sources have them: s[j] are the steps of an axis, m those of the master, p[j] its place.
const listings: Partial<Record<MethodCode, Line[]>> = {
  'master-slave': [
    ...loop('m'),
    { code: '    if (2*k*s[j] >= (2*p[j] + 1)*m)', runs: 'each', shows: 'ideal' },
    { code: '      ++p[j];', runs: 'step' },
  ],
  lean: [
    { code: 'd[j] = -m;', runs: 'start' },
    ...loop('m'),
    { code: '    d[j] += 2*s[j];', runs: 'each', shows: 'sum' },
    ...stepOf('d[j] >= 0', 'd[j] -= 2*m'),
  ],
  dda: integration('0'),
  'dda-half': integration('(1 << bits)/2'),
  'slope-recalculated': [
    { code: 'for (k = 1; k <= dx; ++k)', runs: 'each' },
    { code: '  if (k > 1 && (dy - y)/(dx - x) >= dy/dx)', runs: 'each', shows: 'slope_left' },
    { code: '    ++x, ++y;', runs: 'both' },
    { code: '  else', runs: 'along' },
    { code: '    ++x;', runs: 'along' },
  ],
  'point-comparison': comparison('nx + ny'),
  'listing:rounding': [
    ...loop('m'),
    { code: '    q = round((s[j]/m)*k);', runs: 'each', shows: 'ideal' },
    { code: '    if (q != p[j])', runs: 'each' },
    { code: '      ++p[j];', runs: 'step' },
  ],
  'listing:shared-variable': [
    { code: 'd = +m;', runs: 'start' },
    ...loop('m'),
    { code: '    d += 2*s[j];', runs: 'each', shows: 'sum' },
    ...stepOf('d >= 0', 'd -= 2*m'),
  ],
  'listing:projection': comparison('n'),
};
const linesOf = (answer: Interpolation): Line[] | undefined => listings[codeOf(answer)];
export const hasCode = (answer: Interpolation): boolean => linesOf(answer) !== undefined;

export function CodeView({ answer, beat }: { answer: Interpolation; beat: number }): JSX.Element | null {
  const lines = linesOf(answer);
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
    return line.runs === 'each' || line.runs === 'start' || !line.code.includes('++') ? '' : stepped.join(' ');
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
