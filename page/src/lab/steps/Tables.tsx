// The beats of one method as a table, and the figures of all methods.
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import type { Figures, Interpolation, Rule } from '../core';
import { short } from '../shared';
import { axisNames, codeOf, type MethodCode } from '../view';
import { cellText, columnWords, say, methodWords } from '../words';

const rowsAround = 24; // of the present pulse, in a long move

export function feedText(answer: Interpolation, pulse: number): string {
  const steps = answer.steps[pulse] ?? 0;
  const directions = answer.directions[pulse] ?? 0;
  const text = axisNames.map((name, axis) => (((steps >> axis) & 1) === 0 ? '' : `${((directions >> axis) & 1) === 1 ? '−' : '+'}${name.toUpperCase()}`)).join('');
  return text === '' ? '–' : text;
}

export function BeatTable({ answer, beat, onBeat }: { answer: Interpolation; beat: number; onBeat: (beat: number) => void }): JSX.Element {
  const present = useRef<HTMLTableRowElement>(null);
  const frame = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const row = present.current;
    const box = frame.current;
    if (!row || !box) return;
    const away = row.offsetTop - box.scrollTop - box.clientHeight / 2;
    if (Math.abs(away) > box.clientHeight / 2 - 2 * row.offsetHeight) box.scrollTop = row.offsetTop - box.clientHeight / 2;
  }, [beat, answer]);
  const judge = Object.entries(answer.judge);
  const decisions = Object.entries(answer.decisions);
  const end = Object.entries(answer.end);
  const from = answer.pulses > 4 * rowsAround ? Math.max(0, beat - 1 - rowsAround) : 0;
  const until = answer.pulses > 4 * rowsAround ? Math.min(answer.pulses, beat + rowsAround) : answer.pulses;
  const rows = Array.from({ length: until - from }, (_, i) => from + i);
  return (
    <div class="lab-table-frame lab-beats" ref={frame} tabIndex={0} role="region" aria-label={say('beatsTitle')}>
      <table>
        <thead>
          <tr>
            <th>{say('pulse')}</th>
            {judge.map(([name]) => <th key={name}>{columnWords(name)}</th>)}
            <th>{say('feed')}</th>
            {answer.places.map((_, axis) => <th key={axis}>{axisNames[axis]}</th>)}
            <th>{say('error')}</th>
            {decisions.map(([name]) => <th key={name}>{columnWords(name)}</th>)}
            {end.map(([name]) => <th key={name}>{columnWords(name)}</th>)}
          </tr>
        </thead>
        <tbody>
          {rows.map((pulse) => (
            <tr
              key={pulse}
              ref={pulse === beat - 1 ? present : null}
              class={`${pulse === beat - 1 ? 'lab-present' : pulse < beat ? '' : 'lab-to-come'}${answer.fault?.wrong.includes(pulse + 1) ? ' lab-wrong-row' : ''}`}
              aria-current={pulse === beat - 1 ? 'step' : undefined}
              onClick={() => onBeat(pulse + 1)}
            >
              <td>{pulse + 1}</td>
              {judge.map(([name, cells]) => <td key={name}>{cellText(cells[pulse] ?? '')}</td>)}
              <td class="lab-feed">{feedText(answer, pulse)}</td>
              {answer.places.map((places, axis) => <td key={axis}>{places[pulse]}</td>)}
              <td>{(answer.deviation[pulse] ?? 0).toFixed(3)}</td>
              {decisions.map(([name, cells]) => <td key={name}>{cells[pulse]}</td>)}
              {end.map(([name, cells]) => <td key={name}>{cells[pulse]}</td>)}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

interface ComparisonProps {
  methods: readonly Figures[];
  a: MethodCode;
  b: MethodCode | 'none';
  rule: Rule;
  onA: (code: MethodCode) => void;
  onB: (code: MethodCode | 'none') => void;
}
export function Comparison({ methods, a, b, rule, onA, onB }: ComparisonProps): JSX.Element {
  const most = Math.max(...methods.map((one) => one.largest), 0.001);
  return (
    <div class="lab-table-frame" tabIndex={0} role="region" aria-label={say('comparison')}>
      <table class="lab-comparison">
        <thead>
          <tr>
            <th>{say('method')}</th>
            <th>A</th>
            <th>B</th>
            <th>{say('largestError')}</th>
            <th>{say('meanError')}</th>
            <th>{say('pulses')}</th>
            <th>{say('together')}</th>
            <th>{say('idle')}</th>
            <th>{say('lag')}</th>
            <th>{say('fastestSlowest')}</th>
          </tr>
        </thead>
        <tbody>
          {methods.map((one) => {
            const code = codeOf(one);
            return (
              <tr key={code} class={code === a ? 'lab-present' : ''}>
                <th scope="row">{methodWords(code)}</th>
                <td>
                  <input type="radio" name="lab-a" class="mark-a" checked={code === a} aria-label={`A: ${methodWords(code)}`} onChange={() => onA(code)} />
                </td>
                <td>
                  <input type="checkbox" class="mark-b" checked={code === b} aria-label={`B: ${methodWords(code)}`} onChange={() => onB(code === b ? 'none' : code)} />
                </td>
                <td class="lab-bar" style={{ '--share': one.largest / most }}>
                  <span>{one.largest.toFixed(3)}</span>
                </td>
                <td>{one.mean.toFixed(3)}</td>
                <td>{one.pulses}</td>
                <td>{one.together}</td>
                <td>{one.idle}</td>
                <td>{one.lag[rule].toFixed(2)}</td>
                <td>{short(one.ratio[rule])}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}
