// Probing cycles: each with a picture of what will happen, its figures, and what it sets. And the height map of a program.
import { useEffect, useRef } from 'preact/hooks';
import { say } from '../core/language';
import { fromMm, lengthText, lengthUnit, speedUnit, toMm, units } from '../core/units';
import { whyNoSetUp, whyNot } from '../machine/actions';
import { isLive, status } from '../machine/connection';
import {
  fieldsOf, figure, heightMap, kind, kinds, level, lookForMap, probe, setValue, side, sideOf, stepsOf, valueOf, valuesOf, waysOf,
  type Field, type HeightMap, type Kind,
} from '../machine/probing';
import { programForMap, shown } from '../machine/programs';
import { Button } from './button';
import { viewsOf, type CycleView, type Spot } from './cycle_picture';
import { Typed } from './typed';
import { Choice } from './view_dialog';

const room = 12; // around a picture, in its own units
const wide = 320;
const high = 210;

// Fits the places of a view into the picture.
function fitted(view: CycleView): (spot: Spot) => [number, number] {
  const all = [...view.work.flat(), ...view.way];
  const [left, right] = [Math.min(...all.map((one) => one[0])), Math.max(...all.map((one) => one[0]))];
  const [low, top] = [Math.min(...all.map((one) => one[1])), Math.max(...all.map((one) => one[1]))];
  const scale = Math.min((wide - 2 * room) / Math.max(right - left, 1e-6), (high - 2 * room) / Math.max(top - low, 1e-6));
  const [dx, dy] = [(wide - scale * (right - left)) / 2, (high - scale * (top - low)) / 2];
  return ([x, y]) => [dx + scale * (x - left), high - dy - scale * (y - low)];
}

function CyclePicture({ view, name }: { view: CycleView; name: string }) {
  const at = fitted(view);
  const points = (spots: readonly Spot[]): string => spots.map((one) => at(one).map((n) => n.toFixed(1)).join(',')).join(' ');
  const [start, second] = [at(view.way[0] ?? [0, 0]), at(view.way[1] ?? [0, 0])];
  const scale = at([1, 0])[0] - at([0, 0])[0];
  const many = view.touches.length > 12;
  return (
    <figure class="cycle">
      <svg viewBox={`0 0 ${wide} ${high}`} role="img" aria-label={name}>
        {view.work.map((one) => (
          <polygon key={points(one)} class="cycle-work" points={points(one)} />
        ))}
        {view.holes?.map((one) => {
          const [x, y] = at(one.at);
          return <circle key={`${x} ${y}`} class="cycle-hole" cx={x} cy={y} r={one.radius * scale} />;
        })}
        <polyline class="cycle-way" points={points(view.way)} />
        <circle class="cycle-start" cx={start[0]} cy={start[1]} r="6" />
        <line class="cycle-start" x1={start[0]} y1={start[1]} x2={start[0] + (second[0] - start[0]) * 0.3} y2={start[1] + (second[1] - start[1]) * 0.3} />
        {view.touches.map((one, i) => {
          const [x, y] = at(one);
          return (
            <g key={`${i} ${x}`} class="cycle-touch">
              <circle cx={x} cy={y} r={many ? 4 : 9} />
              {!many && (
                <text x={x} y={y + 4.5} text-anchor="middle">
                  {i + 1}
                </text>
              )}
            </g>
          );
        })}
        {view.found.map((one) => {
          const [x, y] = at(one);
          return <path key={`${x} ${y}`} class="cycle-found" d={`M${x - 14} ${y}h28M${x} ${y - 14}v28`} />;
        })}
      </svg>
      <figcaption class="dim">{say(view.looks === 'above' ? 'probe.above' : 'probe.beside')}</figcaption>
    </figure>
  );
}

const isLength = (field: Field): boolean => field.measure !== 'count';
const shownValue = (of: Kind, field: Field): string => {
  const value = valueOf(of, field);
  return String(Number((isLength(field) ? fromMm(value) : value).toFixed(4)));
};

function OneField({ of, field }: { of: Kind; field: Field }) {
  const unit = field.measure === 'length' ? lengthUnit() : field.measure === 'speed' ? speedUnit() : '';
  return (
    <label class="form-field">
      <span class="dim">
        {say(field.title)} {unit}
      </span>
      <Typed
        inputMode="decimal"
        value={shownValue(of, field)}
        take={(text) => {
          const typed = Number(text.trim().replace(',', '.'));
          if (text.trim() !== '' && Number.isFinite(typed)) setValue(of, field, isLength(field) ? toMm(typed) : Math.round(typed));
        }}
      />
    </label>
  );
}

export function Probing() {
  const of = kind.value;
  const program = programForMap.value ?? shown.value;
  const job = status.value?.job;
  void units.value;
  // A job that has ended may have found a map.
  useEffect(() => void lookForMap(isLive.value ? (program?.id ?? null) : null), [program?.id, job?.id, job?.state, isLive.value]);
  const ways = waysOf[of];
  const all = fieldsOf(of);
  return (
    <section class="panel probing" aria-label={say('probe.title')}>
      <h2>{say('probe.title')}</h2>
      <Choice title={say('probe.which')} value={of} all={kinds.map((one) => [one, say(`probe.${one}`)] as const)} set={(to) => (kind.value = to)} />
      <div class="probing-body">
        <div class="cycles">
          {viewsOf(of, sideOf(of), valuesOf(of)).map((view) => (
            <CyclePicture key={view.looks} view={view} name={say(`probe.${of}`)} />
          ))}
        </div>
        <div>
          <p>{say(`probe.${of}.from`)}</p>
          <p data-testid="cycle-steps">{stepsOf(of)}</p>
          <p>
            <b>{say(`probe.${of}.sets`)}</b>
          </p>
          {ways !== undefined && (
            <Choice
              title={say(of === 'corner' ? 'probe.side.corner' : 'probe.side')}
              value={sideOf(of)}
              all={ways.map((one) => [one, of === 'corner' ? say(`probe.${one}` as 'probe.front-left') : one.toUpperCase().replace('-', '−')] as const)}
              set={(to) => (side.value = { ...side.value, [of]: to })}
            />
          )}
          <div class="form-fields">
            {all.filter((field) => field.rare !== true).map((field) => (
              <OneField key={field.name} of={of} field={field} />
            ))}
          </div>
          <details>
            <summary>{say('probe.more')}</summary>
            <div class="form-fields">
              {all.filter((field) => field.rare === true).map((field) => (
                <OneField key={field.name} of={of} field={field} />
              ))}
            </div>
          </details>
          <Button kind="accent" icon="probe" why={whyNoSetUp()} onClick={() => probe(of, programForMap.value)}>
            {say('probe.begin')} …
          </Button>
        </div>
      </div>
      <MapPanel />
    </section>
  );
}

// Between the lowest and the highest: the colours of the scene. A pixel for each place of the grid; what is between is
// the browser's to smooth, and only a picture.
function drawMap(canvas: HTMLCanvasElement, map: HeightMap): void {
  const pen = canvas.getContext('2d');
  const grid = document.createElement('canvas');
  const dots = grid.getContext('2d');
  if (pen === null || dots === null) return;
  const [columns, rows] = [map.columns.length, map.rows.length];
  [grid.width, grid.height] = [columns, rows];
  const side = 6; // pixels of the picture from place to place
  [canvas.width, canvas.height] = [(columns - 1) * side, (rows - 1) * side];
  const colours = getComputedStyle(canvas);
  const parse = (name: string): number[] => [1, 3, 5].map((i) => parseInt(colours.getPropertyValue(name).trim().slice(i, i + 2), 16));
  const [slow, fast] = [parse('--slow'), parse('--fast')];
  const span = Math.max(map.highest - map.lowest, 1e-9);
  map.heights.forEach((row, r) =>
    row.forEach((height, c) => {
      const mixed = slow.map((low, k) => Math.round(low + ((height - map.lowest) / span) * ((fast[k] ?? 0) - low)));
      dots.fillStyle = `rgb(${mixed.join(',')})`;
      dots.fillRect(c, rows - 1 - r, 1, 1);
    }),
  );
  pen.drawImage(grid, 0.5, 0.5, columns - 1, rows - 1, 0, 0, canvas.width, canvas.height);
}

function MapPanel() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const program = programForMap.value ?? shown.value;
  const known = heightMap.value;
  const map = known !== null && known.program === program?.id ? known.map : null;
  useEffect(() => {
    if (canvas.current !== null && map !== null) drawMap(canvas.current, map);
  }, [map]);
  if (program === null || map === null) return <p class="dim">{say('map.none')}</p>;
  const [first, last] = [map.columns[0] ?? 0, map.columns.at(-1) ?? 0];
  const [low, top] = [map.rows[0] ?? 0, map.rows.at(-1) ?? 0];
  const few = map.columns.length * map.rows.length <= 120;
  const legend = (mm: number): string => `${lengthText(mm, 3)} ${lengthUnit()}`;
  return (
    <div class="map" data-testid="height-map">
      <h2>{say('map.title', { name: program.name })}</h2>
      <div class="map-picture" style={{ aspectRatio: `${Math.max(last - first, 1)} / ${Math.max(top - low, 1)}` }}>
        <canvas ref={canvas} role="img" aria-label={say('map.title', { name: program.name })} />
        {few &&
          map.heights.flatMap((line, r) =>
            line.map((height, c) => (
              <span
                key={`${r} ${c}`}
                aria-hidden="true"
                style={{ left: `${(100 * c) / (map.columns.length - 1)}%`, bottom: `${(100 * r) / (map.rows.length - 1)}%` }}
              >
                {lengthText(height, 2)}
              </span>
            )),
          )}
      </div>
      <p class="scene-legend map-legend">
        <span>{legend(map.lowest)}</span> <i /> <span>{legend(map.highest)}</span>
      </p>
      <p>
        {say('map.figures', {
          columns: map.columns.length,
          rows: map.rows.length,
          span: legend(map.highest - map.lowest),
          x: figure(map.rise_x * 1000),
          y: figure(map.rise_y * 1000),
          off: legend(map.off_plane),
        })}
      </p>
      <Button icon="done" why={whyNot('Idle')} onClick={() => level(program)}>
        {say('map.level')}
      </Button>
    </div>
  );
}
