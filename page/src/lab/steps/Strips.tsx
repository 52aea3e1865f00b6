// The pulse trains: when the motors step, over the time of the move. A pulse up counts up, a pulse down counts down.
import type { JSX } from 'preact';
import type { Rule, Windings } from '../core';
import { useSize } from '../shared';
import { say } from '../words';
import { axisNames } from '../view';
import type { Played } from './Grid';

interface StripsProps {
  played: readonly Played[];
  names: readonly string[]; // of the methods
  rule: Rule;
  share: number;
  windings?: Windings | undefined; // of the motor below
  motor: number; // whose windings are shown
  onSeek: (share: number) => void;
}

const motorName = (axis: number): string => (axisNames[axis] ?? '').toUpperCase();
const row = 34;
const left = 34;

export function Strips({ played, names, rule, share, windings, motor, onSeek }: StripsProps): JSX.Element {
  const [element, size] = useSize<HTMLDivElement>();
  const width = Math.max(size.width, 200);
  const inner = width - left - 10;
  const px = (part: number): number => left + part * inner;
  const rows = played.flatMap((one, i) =>
    one.answer.places.map((_, axis) => ({ one, axis, name: motorName(axis), title: axis === 0 ? (names[i] ?? '') : '' })),
  );
  const motors = played[0]?.answer.places.length ?? 2;
  const windingsTop = rows.length * row + played.length * 14 + 8;
  const height = windingsTop + (windings ? 14 + 4 * 20 : 0) + 4;
  const pulseWidth = Math.min(5, (inner / Math.max(1, played[0]?.answer.pulses ?? 1)) * 0.5);
  return (
    <div class="lab-strips" ref={element}>
      <svg
        viewBox={`0 0 ${width} ${height}`}
        role="img"
        aria-label={say('strips')}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={(event) => {
          if (event.buttons === 0) return;
          const from = event.currentTarget.getBoundingClientRect().left;
          onSeek(Math.min(1, Math.max(0, ((event.clientX - from) / size.unit - left) / inner)));
        }}
      >
        {rows.map(({ one, axis, name, title }, i) => {
          const base = i * row + (Math.floor(i / motors) + 1) * 14 + row / 2 + 2;
          const clock = one.answer.clock[rule];
          let path = `M${left} ${base}`;
          one.answer.steps.forEach((steps, k) => {
            if (((steps >> axis) & 1) === 0) return;
            const down = (((one.answer.directions[k] ?? 0) >> axis) & 1) === 1;
            const x = px(clock[k] ?? 1);
            path += `H${(x - pulseWidth).toFixed(1)}v${down ? 13 : -13}H${x.toFixed(1)}V${base}`;
          });
          return (
            <g key={`${one.mark}${name}`}>
              {title !== '' && (
                <text class="lab-strip-title" x={left} y={base - row / 2 - 2}>
                  {title}
                </text>
              )}
              <text class="lab-strip-name" x={8} y={base + 4}>
                {name}
              </text>
              <path class={`lab-train ${one.mark}`} d={`${path}H${px(1)}`} />
            </g>
          );
        })}
        {windings && played[0] && (
          <WindingStrips windings={windings} motor={motor} played={played[0]} rule={rule} top={windingsTop} px={px} />
        )}
        <line class="lab-cursor" x1={px(share)} x2={px(share)} y1={0} y2={height} />
      </svg>
    </div>
  );
}

interface WindingStripsProps {
  windings: Windings;
  motor: number;
  played: Played;
  rule: Rule;
  top: number;
  px: (share: number) => number;
}
function WindingStrips({ windings, motor, played, rule, top, px }: WindingStripsProps): JSX.Element {
  const clock = played.answer.clock[rule];
  const first = windings.first;
  // From one pulse to the next the outputs stay as they are.
  const places = played.answer.places[motor] ?? [];
  const states = [places[0] ?? 0, ...places].map((at, k) => ({
    at: k === 0 ? 0 : (clock[k - 1] ?? 1),
    until: clock[k] ?? 1,
    place: (k === 0 ? startOf(played, motor) : at) - first,
  }));
  return (
    <g>
      <text class="lab-strip-title" x={left} y={top + 4}>
        {say('windingsOf', { axis: motorName(motor) })}
      </text>
      {[0, 1, 2, 3].map((output) => {
        const base = top + 12 + output * 20 + 14;
        return (
          <g key={output}>
            <text class="lab-strip-name" x={8} y={base}>
              F{output + 1}
            </text>
            <line class="lab-base" x1={left} x2={px(1)} y1={base + 1} y2={base + 1} />
            {states.map((state, k) => {
              const phase = output % 2 === 0 ? windings.phase_a[state.place] : windings.phase_b[state.place];
              const current = Math.max(0, (output < 2 ? 1 : -1) * (phase ?? 0));
              if (current === 0 || state.until <= state.at) return null;
              return (
                <rect
                  key={k}
                  class="lab-current"
                  x={px(state.at)}
                  width={px(state.until) - px(state.at) + 0.3}
                  y={base + 1 - 14 * current}
                  height={14 * current}
                />
              );
            })}
          </g>
        );
      })}
    </g>
  );
}

// Where an axis stood before the first pulse.
export function startOf({ answer }: Played, axis: number): number {
  const after = answer.places[axis]?.[0] ?? 0;
  if ((((answer.steps[0] ?? 0) >> axis) & 1) === 0) return after;
  return (((answer.directions[0] ?? 0) >> axis) & 1) === 1 ? after + 1 : after - 1;
}
