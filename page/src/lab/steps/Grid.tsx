// The move on the grid of steps: the ideal path with its corridor of half a step, the path of one method or two, the tool,
// and the end point, which is dragged by pointer or keys.
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';
import type { Interpolation } from '../core';
import { short, type Size, useSize } from '../shared';
import { say } from '../words';

export interface Played {
  answer: Interpolation;
  beat: number;
  mark: 'mark-a' | 'mark-b';
}
interface GridProps {
  played: readonly Played[]; // one or two; the first is judged
  start: readonly [number, number];
  end: readonly [number, number];
  centre?: readonly [number, number]; // of an arc
  share: number; // of the time
  longest?: number; // steps of the master, where midlines are drawn
  onEnd: (place: [number, number]) => void;
  onStart?: (place: [number, number]) => void; // an arc's start gives the radius
}

interface Box {
  x: number; // of the left edge, in steps
  y: number; // of the top edge
  scale: number; // pixels a step
}

const least = { width: 12, height: 7 }; // steps that are always seen

function boxOf({ played, start, end, centre }: GridProps, size: Size): Box {
  const xs = [start[0], end[0], ...(played[0]?.answer.ideal.x ?? [])];
  const ys = [start[1], end[1], ...(played[0]?.answer.ideal.y ?? [])];
  if (centre) xs.push(centre[0]), ys.push(centre[1]);
  const low = [Math.min(...xs) - 1.2, Math.min(...ys) - 1.2] as const;
  const high = [Math.max(...xs) + 1.4, Math.max(...ys) + 1.4] as const;
  const width = Math.max(high[0] - low[0], least.width);
  const height = Math.max(high[1] - low[1], least.height);
  const scale = Math.max(0.5, Math.min(size.width / width, size.height / height));
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2] as const;
  return { x: middle[0] - size.width / scale / 2, y: middle[1] + size.height / scale / 2, scale };
}

// The point of the ideal path after a share of its length. Its chords are equally long.
function idealAt(ideal: { x: number[]; y: number[] }, share: number): [number, number] {
  const at = Math.min(1, Math.max(0, share)) * (ideal.x.length - 1);
  const i = Math.min(Math.floor(at), ideal.x.length - 2);
  const part = at - i;
  const mix = (values: number[]): number => (values[i] ?? 0) * (1 - part) + (values[i + 1] ?? 0) * part;
  return [mix(ideal.x), mix(ideal.y)];
}

export function Grid(props: GridProps): JSX.Element {
  const [element, size] = useSize<HTMLDivElement>();
  const frozen = useRef<Box | undefined>(undefined);
  const box = frozen.current ?? boxOf(props, size);
  const { played, start, end, centre, share } = props;
  const first = played[0];
  const px = (x: number): number => (x - box.x) * box.scale;
  const py = (y: number): number => (box.y - y) * box.scale;
  const place = (x: number, y: number): string => `${px(x).toFixed(1)} ${py(y).toFixed(1)}`;
  const line = (xs: readonly number[], ys: readonly number[]): string =>
    xs.map((x, i) => `${i === 0 ? 'M' : 'L'}${place(x, ys[i] ?? 0)}`).join('');

  const handle = (
    at: readonly [number, number],
    label: string,
    name: string,
    onMove: (place: [number, number]) => void,
  ): JSX.Element => {
    const moved = (event: PointerEvent): void => {
      const svg = (event.currentTarget as SVGElement).ownerSVGElement;
      if (!svg || !frozen.current) return;
      const corner = svg.getBoundingClientRect();
      onMove([
        Math.round(frozen.current.x + (event.clientX - corner.left) / size.unit / frozen.current.scale),
        Math.round(frozen.current.y - (event.clientY - corner.top) / size.unit / frozen.current.scale),
      ]);
    };
    const let_go = (): void => {
      frozen.current = undefined;
      onMove([at[0], at[1]]);
    };
    return (
      <g
        class={`lab-handle ${name}`}
        tabindex={0}
        role="slider"
        aria-label={label}
        aria-valuenow={at[0]}
        aria-valuetext={`x ${at[0]}, y ${at[1]}`}
        transform={`translate(${place(at[0], at[1])})`}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          frozen.current = box;
        }}
        onPointerMove={moved}
        onPointerUp={let_go}
        onPointerCancel={let_go}
        onKeyDown={(event) => {
          const far = event.shiftKey ? 10 : 1;
          const by = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
          if (!by) return;
          event.preventDefault();
          onMove([at[0] + (by[0] ?? 0) * far, at[1] + (by[1] ?? 0) * far]);
        }}
      >
        <circle class="lab-touch" r="24" />
        <circle class="lab-ring" r="11" />
      </g>
    );
  };

  const beat = first?.beat ?? 0;
  const tool = beat > 0 && first ? ([first.answer.x[beat - 1] ?? 0, first.answer.y[beat - 1] ?? 0] as const) : start;
  const foot =
    beat > 0 && first ? ([first.answer.foot_x[beat - 1] ?? 0, first.answer.foot_y[beat - 1] ?? 0] as const) : start;
  const error = beat > 0 ? (first?.answer.deviation[beat - 1] ?? 0) : 0;
  const runner = first ? idealAt(first.answer.ideal, share) : start;
  const dots = box.scale >= 7;
  const fault = first?.answer.fault;
  return (
    <div class="lab-grid-frame" ref={element}>
      {first && size.width > 0 && (
        <svg viewBox={`0 0 ${size.width} ${size.height}`} role="group" aria-label={say('grid')}>
          <GridLines box={box} size={size} />
          <path
            class="lab-corridor"
            style={{ strokeWidth: box.scale }}
            d={line(first.answer.ideal.x, first.answer.ideal.y)}
          />
          <path class="lab-line mark-ideal" d={line(first.answer.ideal.x, first.answer.ideal.y)} />
          {centre && <path class="lab-centre" d={`M${place(centre[0], centre[1])}m-5 0h10m-5 -5v10`} />}
          {[...played].reverse().map(({ answer, beat: until, mark }) => {
            const xs = [start[0], ...answer.x];
            const ys = [start[1], ...answer.y];
            return (
              <g key={mark} class={`lab-path ${mark}`}>
                <path class="lab-ahead" d={line(xs.slice(until), ys.slice(until))} />
                <path class="lab-done" d={line(xs.slice(0, until + 1), ys.slice(0, until + 1))} />
                {dots &&
                  answer.x.slice(0, until).map((x, i) =>
                    mark === 'mark-a' ? (
                      <circle key={i} cx={px(x)} cy={py(answer.y[i] ?? 0)} r={Math.min(4, box.scale / 6)} />
                    ) : (
                      <rect
                        key={i}
                        x={px(x) - Math.min(3.4, box.scale / 7)}
                        y={py(answer.y[i] ?? 0) - Math.min(3.4, box.scale / 7)}
                        width={2 * Math.min(3.4, box.scale / 7)}
                        height={2 * Math.min(3.4, box.scale / 7)}
                      />
                    ),
                  )}
              </g>
            );
          })}
          {props.longest !== undefined && first && (
            <Midlines answer={first.answer} end={end} longest={props.longest} beat={beat} box={box} />
          )}
          {first &&
            fault?.wrong.map((k) => {
              const from = k > 1 ? ([first.answer.x[k - 2] ?? 0, first.answer.y[k - 2] ?? 0] as const) : start;
              return (
                <path
                  key={k}
                  class={`lab-wrong${k <= beat ? '' : ' lab-ahead'}`}
                  d={`M${place(from[0], from[1])}L${place(first.answer.x[k - 1] ?? 0, first.answer.y[k - 1] ?? 0)}`}
                />
              );
            })}
          {first && fault && !fault.ends_right && (
            <path class="lab-wrong" d={`M${place(first.answer.x.at(-1) ?? 0, first.answer.y.at(-1) ?? 0)}m-8 -8l16 16m-16 0l16 -16`} />
          )}
          <circle class="lab-start" cx={px(start[0])} cy={py(start[1])} r="4" />
          <circle class="lab-runner" cx={px(runner[0])} cy={py(runner[1])} r="6" />
          <path class="lab-whisker" d={`M${place(tool[0], tool[1])}L${place(foot[0], foot[1])}`} />
          {error > 0.001 && (
            <text class="lab-error" x={px(tool[0]) + 12} y={py(tool[1]) + (tool[1] < foot[1] ? 22 : -12)}>
              {short(error)}
            </text>
          )}
          {handle(end, say('endPoint'), 'lab-end', props.onEnd)}
          {props.onStart && handle(start, say('startPoint'), 'lab-begin', props.onStart)}
          <circle class="lab-tool" cx={px(tool[0])} cy={py(tool[1])} r="7" />
        </svg>
      )}
    </div>
  );
}

interface MidlinesProps {
  answer: Interpolation;
  end: readonly [number, number];
  longest: number;
  beat: number;
  box: Box;
}
// Master and slaves: the middle of each side through which the ideal line leaves a cell, and at which part of the side it
// does. The slave steps where that is at the midline or above it.
function Midlines({ answer, end, longest, beat, box }: MidlinesProps): JSX.Element | null {
  const master = Math.abs(end[0]) === longest ? 0 : 1;
  const slave = Math.abs(end[1 - master] ?? 0);
  if (Math.abs(end[master]) !== longest || slave === 0 || slave === longest || box.scale < 14) return null;
  const [along, across] = [Math.sign(end[master]), Math.sign(end[1 - master] ?? 0)];
  const spot = (k: number, height: number): [number, number] => {
    const [x, y] = master === 0 ? [along * k, across * height] : [across * height, along * k];
    return [(x - box.x) * box.scale, (box.y - y) * box.scale];
  };
  const stands = master === 0 ? answer.y : answer.x;
  return (
    <g class="lab-midlines" aria-hidden="true">
      {stands.map((_, i) => {
        const k = i + 1;
        const [x, y] = spot(k, Math.abs(i === 0 ? 0 : (stands[i - 1] ?? 0)) + 0.5);
        const half = 0.28 * box.scale;
        return <path key={k} d={master === 0 ? `M${x - half} ${y}h${2 * half}` : `M${x} ${y - half}v${2 * half}`} />;
      })}
      {stands.map((_, i) => {
        const k = i + 1;
        const part = (k * slave) % longest;
        if (part === 0 || k > beat || (k !== beat && box.scale < 40)) return null;
        const [x, y] = spot(k, (k * slave) / longest);
        return (
          <g key={k} class={k === beat ? 'lab-now' : ''}>
            <circle cx={x} cy={y} r="3" />
            <text x={x + 6} y={y + (across > 0 ? 15 : -7)}>{`${part}/${longest}`}</text>
          </g>
        );
      })}
    </g>
  );
}

// A line for each step where there is room, else for each 5th, 10th, …
function GridLines({ box, size }: { box: Box; size: Size }): JSX.Element {
  const every = [1, 5, 10, 50, 100].find((step) => step * box.scale >= 9) ?? 100;
  const named = [1, 2, 5, 10, 20, 50, 100].find((step) => step >= every && step * box.scale >= 30) ?? 100;
  const whole = (from: number, to: number): number[] => {
    const values: number[] = [];
    for (let value = Math.ceil(from / every) * every; value <= to; value += every) values.push(value);
    return values;
  };
  const px = (x: number): number => (x - box.x) * box.scale;
  const py = (y: number): number => (box.y - y) * box.scale;
  const xs = whole(box.x, box.x + size.width / box.scale);
  const ys = whole(box.y - size.height / box.scale, box.y);
  const kind = (value: number): string => (value === 0 ? 'lab-zero' : value % (named === 1 ? 5 : named) === 0 ? 'lab-fifth' : '');
  const rowOfNames = Math.min(size.height - 6, Math.max(16, py(0) + 16));
  const columnOfNames = Math.min(size.width - 8, Math.max(22, px(0) - 7));
  return (
    <g class="lab-lattice" aria-hidden="true">
      {xs.map((x) => (
        <line key={`x${x}`} class={kind(x)} x1={px(x)} x2={px(x)} y1={0} y2={size.height} />
      ))}
      {ys.map((y) => (
        <line key={`y${y}`} class={kind(y)} x1={0} x2={size.width} y1={py(y)} y2={py(y)} />
      ))}
      {xs
        .filter((x) => x % named === 0 && x !== 0)
        .map((x) => (
          <text key={`tx${x}`} x={px(x)} y={rowOfNames} text-anchor="middle">
            {x}
          </text>
        ))}
      {ys
        .filter((y) => y % named === 0 && y !== 0)
        .map((y) => (
          <text key={`ty${y}`} x={columnOfNames} y={py(y) + 4} text-anchor="end">
            {y}
          </text>
        ))}
    </g>
  );
}
