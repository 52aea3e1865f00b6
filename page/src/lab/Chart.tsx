// A chart of lines over one axis, with a reading under the pointer or the arrow keys. It is drawn as SVG, so it is sharp on
// any screen and follows the theme by itself. Lines differ in their dashes as well as in their colours.
import type { JSX } from 'preact';
import { useState } from 'preact/hooks';
import { short, useSize } from './shared';

export interface ChartLine {
  name: string;
  mark: string; // class of its colour and dashes: "mark-a", "mark-ideal"
  x: readonly number[];
  y: readonly number[];
  dots?: boolean;
}
interface ChartProps {
  title: string;
  xTitle: string;
  yTitle: string;
  lines: readonly ChartLine[];
  height?: number;
  logarithmic?: boolean; // values are shown by their size, from `least` on
  least?: number;
  from?: number; // the vertical axis begins at least here
  marks?: readonly { x: number; words: string }[];
}

const margin = { left: 58, right: 14, top: 12, bottom: 40 };

export function niceStep(span: number, most: number): number {
  const rough = span / Math.max(1, most);
  const power = 10 ** Math.floor(Math.log10(rough));
  const found = [1, 2, 5, 10].find((step) => step * power >= rough * (1 - 1e-9));
  return (found ?? 10) * power;
}
export function ticksOf(low: number, high: number, most: number): number[] {
  if (!(high > low)) return [low];
  const step = niceStep(high - low, most);
  const ticks: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) ticks.push(i * step + 0); // never −0
  return ticks;
}
function tickText(value: number, step: number): string {
  const decimals = Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)));
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? '0' : text;
}
const extentOf = (all: readonly (readonly number[])[]): [number, number] => {
  let low = Infinity;
  let high = -Infinity;
  for (const values of all) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 1];
};

// The entry of ascending values that is nearest to `at`.
export function nearest(values: readonly number[], at: number): number {
  let low = 0;
  let high = values.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((values[middle] ?? 0) < at) low = middle + 1;
    else high = middle;
  }
  return low > 0 && at - (values[low - 1] ?? 0) < (values[low] ?? 0) - at ? low - 1 : low;
}

export function Chart(props: ChartProps): JSX.Element {
  const { title, xTitle, yTitle, lines, height = 260, logarithmic = false, least = 0.001, marks = [] } = props;
  const [element, size] = useSize<HTMLDivElement>();
  const [at, setAt] = useState<number | undefined>();
  const width = Math.max(size.width, 200);
  const inner = { width: width - margin.left - margin.right, height: height - margin.top - margin.bottom };
  const [xLow, xHigh] = extentOf(lines.map((line) => line.x));
  const shown = (value: number): number => (logarithmic ? Math.log10(Math.max(Math.abs(value), least)) : value);
  let [yLow, yHigh] = extentOf(lines.map((line) => line.y.map(shown)));
  if (logarithmic) {
    yLow = Math.floor(yLow + 1e-9);
    yHigh = Math.max(Math.ceil(yHigh - 1e-9), yLow + 1);
  } else {
    yLow = Math.min(yLow, props.from ?? yLow);
    if (yLow === yHigh) yHigh = yLow + 1;
    const step = niceStep(yHigh - yLow, 5);
    yLow = Math.floor(yLow / step + 1e-9) * step;
    yHigh = Math.ceil(yHigh / step - 1e-9) * step;
  }
  // A logarithmic scale has no place for 0: there the line ends, and begins anew after it.
  const seen = (value: number | undefined): boolean => value !== undefined && (!logarithmic || Math.abs(value) >= least);
  const xSpan = xHigh > xLow ? xHigh - xLow : 1;
  const px = (x: number): number => margin.left + ((x - xLow) / xSpan) * inner.width;
  const py = (y: number): number => margin.top + (1 - (shown(y) - yLow) / (yHigh - yLow)) * inner.height;
  const bottom = margin.top + inner.height;
  const xTicks = ticksOf(xLow, xHigh, inner.width / 80);
  const yTicks = logarithmic
    ? Array.from({ length: Math.round(yHigh - yLow) + 1 }, (_, i) => 10 ** (yLow + i))
    : ticksOf(yLow, yHigh, inner.height / 40);
  const xStep = niceStep(xSpan, inner.width / 80);
  const yStep = niceStep(yHigh - yLow, inner.height / 40);

  const move = (to: number): void => setAt(Math.min(xHigh, Math.max(xLow, to)));
  const readings = at === undefined ? [] : lines.filter((line) => line.x.length > 2).map((line) => {
    const entry = nearest(line.x, at);
    return { line, x: line.x[entry] ?? 0, y: line.y[entry] ?? 0 };
  });
  const reading = readings.map(({ line, y }) => `${line.name} ${short(y, 4)}`).join(', ');

  return (
    <figure class="lab-chart" ref={element}>
      <figcaption>{title}</figcaption>
      <ul class="lab-legend">
        {lines.map((line) => (
          <li key={line.name}>
            <svg width="26" height="10" aria-hidden="true">
              <line class={`lab-line ${line.mark}`} x1="1" x2="25" y1="5" y2="5" />
            </svg>
            {line.name}
            <output>{readings.filter((one) => one.line === line).map((one) => short(one.y, 4))}</output>
          </li>
        ))}
      </ul>
      <svg
        viewBox={`0 0 ${width} ${height}`}
        role="slider"
        tabindex={0}
        aria-label={`${title}. ${xTitle}`}
        aria-valuemin={xLow}
        aria-valuemax={xHigh}
        aria-valuenow={at ?? xLow}
        aria-valuetext={at === undefined ? '' : `${short(at, 4)}: ${reading}`}
        onPointerMove={(event) => {
          const box = event.currentTarget.getBoundingClientRect();
          move(xLow + (((event.clientX - box.left) / size.unit - margin.left) / inner.width) * xSpan);
        }}
        onPointerLeave={() => setAt(undefined)}
        onBlur={() => setAt(undefined)}
        onKeyDown={(event) => {
          const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
          if (by === undefined) return;
          event.preventDefault();
          move((at ?? xLow) + (by * xSpan) / 100);
        }}
      >
        <g class="lab-grid">
          {xTicks.map((tick) => (
            <line key={`x${tick}`} x1={px(tick)} x2={px(tick)} y1={margin.top} y2={bottom} />
          ))}
          {yTicks.map((tick) => (
            <line key={`y${tick}`} x1={margin.left} x2={margin.left + inner.width} y1={py(tick)} y2={py(tick)} />
          ))}
        </g>
        <g class="lab-ticks">
          {xTicks.map((tick) => (
            <text key={`x${tick}`} x={px(tick)} y={bottom + 16} text-anchor="middle">
              {tickText(tick, xStep)}
            </text>
          ))}
          {yTicks.map((tick) => (
            <text key={`y${tick}`} x={margin.left - 8} y={py(tick) + 4} text-anchor="end">
              {logarithmic ? String(Number(tick.toPrecision(1))) : tickText(tick, yStep)}
            </text>
          ))}
          <text x={margin.left + inner.width} y={height - 6} text-anchor="end" class="lab-axis">
            {xTitle}
          </text>
          <text transform={`translate(13 ${margin.top + inner.height / 2}) rotate(-90)`} text-anchor="middle" class="lab-axis">
            {yTitle}
          </text>
        </g>
        {marks.map((mark) => (
          <g key={mark.words} class="lab-place">
            <line x1={px(mark.x)} x2={px(mark.x)} y1={margin.top} y2={bottom} />
            <text x={px(mark.x) + (px(mark.x) > width * 0.7 ? -5 : 5)} y={margin.top + 12} text-anchor={px(mark.x) > width * 0.7 ? 'end' : 'start'}>
              {mark.words}
            </text>
          </g>
        ))}
        {lines.map((line) =>
          line.dots === true ? (
            <g key={line.name} class={`lab-dots ${line.mark}`}>
              {line.x.map((x, i) => (
                seen(line.y[i]) && <circle key={i} cx={px(x)} cy={py(line.y[i] ?? 0)} r={1.6} />
              ))}
            </g>
          ) : (
            <path
              key={line.name}
              class={`lab-line ${line.mark}`}
              d={line.x
                .map((x, i) => (seen(line.y[i]) ? `${seen(line.y[i - 1]) ? 'L' : 'M'}${px(x).toFixed(1)} ${py(line.y[i] ?? 0).toFixed(1)}` : ''))
                .join('')}
            />
          ),
        )}
        {at !== undefined && <line class="lab-cursor" x1={px(at)} x2={px(at)} y1={margin.top} y2={bottom} />}
        {readings.map(({ line, x, y }) => (
          <circle key={line.name} class={`lab-reading ${line.mark}`} cx={px(x)} cy={py(y)} r={4} />
        ))}
      </svg>
    </figure>
  );
}
