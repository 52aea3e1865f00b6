// The drawings of a job: a click on a shape selects it for the operation at hand.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { edit, jobFile, needShapes, shapes, type JobFile, type JobOperation, type Shape, type ShapesOfDrawing, type Value } from '../machine/job_file';
import { cam } from '../machine/cam';
import { Choice } from '../parts/view_dialog';
import { drawingsOf, selectors, selects, wanted, wordsOf, type Selector } from './cam_job_values';

export const current = signal(0); // the operation whose form is open
export const hovered = signal<number | null>(null);
const by = signal<Selector>('layer');

interface Drawn {
  drawing: string;
  shape: Shape;
  size: number; // of its box: small shapes are above large ones
}

const sizeOf = (d: string): number => {
  const all = [...d.matchAll(/(-?[\d.e-]+) (-?[\d.e-]+)/g)].map((one) => [Number(one[1]), Number(one[2])] as const);
  const span = (axis: 0 | 1): number => Math.max(...all.map((one) => one[axis])) - Math.min(...all.map((one) => one[axis]));
  return d.includes('a') ? 0 : span(0) * span(1);
};

// The job's zero in the coordinates of its drawings.
export function zeroOf(file: JobFile, boxes: readonly number[][]): readonly [number, number] {
  const zero = file.job?.zero;
  if (zero === 'lower-left' && boxes.length > 0) return [Math.min(...boxes.map((box) => box[0] ?? 0)), Math.min(...boxes.map((box) => box[1] ?? 0))];
  const at = pairOf(zero) ?? [0, 0];
  return [at[0] * unitOf(file), at[1] * unitOf(file)];
}

const unitOf = (file: JobFile): number => (file.job?.units === 'inch' ? 25.4 : file.job?.units === 'cm' ? 10 : 1);

// The words by which operations can select, with those of all drawings.
const wordsOfAll = (drawn: readonly Drawn[], one: Selector): string[] => [...new Set(drawn.flatMap(({ shape }) => wordsOf(shape, one)))];

export function toggle(index: number, one: Selector, word: string): void {
  const operation = jobFile.value?.operations[index];
  if (operation === undefined) return;
  const before = wanted(operation, one);
  const now = before.includes(word) ? before.filter((other) => other !== word) : [...before, word];
  const path = `operation.${index + 1}.${one}`;
  void edit(now.length === 0 ? { do: 'unset', path } : { do: 'set', path, value: now.length === 1 ? now[0]! : now });
}

// The file may have errors.
const pairOf = (value: Value | undefined): readonly [number, number] | null =>
  Array.isArray(value) && typeof value[0] === 'number' && typeof value[1] === 'number' ? [value[0], value[1]] : null;

// X, Y, X, Y in the coordinates of the drawings.
function boxOf(file: JobFile, zero: readonly [number, number], from: readonly [number, number] | null, to: readonly [number, number] | null): number[] {
  const unit = unitOf(file);
  if (from === null || to === null || to[0] <= from[0] || to[1] <= from[1]) return [];
  return [zero[0] + from[0] * unit, zero[1] + from[1] * unit, zero[0] + to[0] * unit, zero[1] + to[1] * unit];
}
function stockBox(file: JobFile, zero: readonly [number, number]): number[] {
  const size = pairOf(file.stock?.size);
  const corner = pairOf(file.stock?.corner) ?? [0, 0];
  return boxOf(file, zero, corner, size === null ? null : [corner[0] + size[0], corner[1] + size[1]]);
}

function Box({ kind, box, name }: { kind: string; box: readonly number[]; name?: string }) {
  if (box.length !== 4) return null;
  return (
    <rect class={kind} x={box[0]} y={box[1]} width={box[2]! - box[0]!} height={box[3]! - box[1]!}>
      {name !== undefined && <title>{name}</title>}
    </rect>
  );
}

function Frame({ file, zero }: { file: JobFile; zero: readonly [number, number] }) {
  return (
    <>
      <Box kind="job-stock" box={stockBox(file, zero)} />
      {file.clamps.map((clamp, index) => (
        <Box key={index} kind="job-clamp" box={boxOf(file, zero, pairOf(clamp.from), pairOf(clamp.to))} name={String(clamp.name ?? '')} />
      ))}
      <path class="job-zero" d={`M${zero[0] - 4} ${zero[1]}h8M${zero[0]} ${zero[1] - 4}v8`} />
    </>
  );
}

function viewOf(file: JobFile, boxes: readonly number[][], zero: readonly [number, number]): string {
  const all = [...boxes, stockBox(file, zero)].filter((box) => box.length === 4);
  if (all.length === 0) return '0 -100 100 100';
  const low = [0, 1].map((axis) => Math.min(...all.map((box) => box[axis]!)));
  const high = [2, 3].map((axis) => Math.max(...all.map((box) => box[axis]!)));
  // Clamps may be much larger than what is cut.
  const isClamped = file.clamps.length > 0;
  const room = (isClamped ? 0.15 : 0.04) * Math.max(high[0]! - low[0]!, high[1]! - low[1]!, 1);
  return `${low[0]! - room} ${-high[1]! - room} ${high[0]! - low[0]! + 2 * room} ${high[1]! - low[1]! + 2 * room}`;
}

function Ticks({ operation, words }: { operation: JobOperation; words: readonly string[] }) {
  if (words.length === 0 || words.length > 60) return null;
  return (
    <div class="job-ticks" role="group" aria-label={say(`job.by.${by.value}`)}>
      {words.map((word) => (
        <label key={word}>
          <input type="checkbox" checked={wanted(operation, by.value).includes(word)} onChange={() => toggle(current.value, by.value, word)} />
          {by.value === 'color' && <span class="job-colour" style={{ background: word }} aria-hidden="true" />}
          <span>{word}</span>
        </label>
      ))}
    </div>
  );
}

export function JobPicture() {
  const file = jobFile.value;
  const sent = cam.value?.files ?? [];
  const drawings = file === null ? [] : [...new Set([...drawingsOf(file), ...file.operations.flatMap((one) => drawingsOf(file, one))])].filter((one) => sent.includes(one));
  useEffect(() => {
    for (const name of drawings) void needShapes(name);
  }, [drawings.join('\n'), shapes.value]);
  if (file === null || drawings.length === 0) return null;
  const read = drawings.flatMap((name) => {
    const one = shapes.value[name];
    return typeof one === 'object' ? [[name, one] as [string, ShapesOfDrawing]] : [];
  });
  const boxes = read.map(([, one]) => one.box).filter((box) => box.length === 4);
  const drawn: Drawn[] = read.flatMap(([drawing, one]) => one.shapes.map((shape) => ({ drawing, shape, size: sizeOf(shape.d) }))).sort((a, b) => b.size - a.size);
  const zero = zeroOf(file, boxes);
  const shown = file.operations[hovered.value ?? current.value];
  const operation = file.operations[current.value];
  const isShown = ({ drawing, shape }: Drawn): boolean => shown !== undefined && shown.values.kind !== 'face' && drawingsOf(file, shown).includes(drawing) && selects(shown, shape);
  const offered = selectors.filter((one) => wordsOfAll(drawn, one).length > 0);
  if (!offered.includes(by.value)) by.value = offered[0] ?? 'layer';
  const click = ({ shape }: Drawn): void => {
    const word = wordsOf(shape, by.value)[0];
    if (word !== undefined && operation !== undefined) toggle(current.value, by.value, word);
  };
  const failed = drawings.map((name) => shapes.value[name]).filter((one): one is string => typeof one === 'string' && one !== '');
  return (
    <section class="panel job-picture" aria-label={say('job.picture')}>
      <h2>{say('job.picture')}</h2>
      {offered.length > 1 && <Choice title={say('job.by')} value={by.value} all={offered.map((one) => [one, say(`job.by.${one}`)] as const)} set={(to) => (by.value = to)} />}
      <svg viewBox={viewOf(file, boxes, zero)} role="img" aria-label={say('job.picture')} data-testid="job-picture">
        <g transform="scale(1 -1)">
          <Frame file={file} zero={zero} />
          {drawn.map((one, index) => (
            <g key={index} class={isShown(one) ? 'job-shape on' : 'job-shape'} data-layer={one.shape.layer} onClick={() => click(one)}>
              <path class="job-hit" d={one.shape.d} fill={one.shape.closed ? 'transparent' : 'none'} />
              <path class="job-stroke" d={one.shape.d} />
              <title>{[one.shape.layer, one.shape.color, ...one.shape.names].filter((word) => word !== '').join(' · ')}</title>
            </g>
          ))}
        </g>
      </svg>
      {failed.map((words) => (
        <pre key={words} class="toml failed" lang="en" tabIndex={0}>
          {words}
        </pre>
      ))}
      {operation !== undefined && operation.values.kind !== 'face' && (
        <>
          <p class="dim">{say('job.click', { operation: current.value + 1 })}</p>
          <Ticks operation={operation} words={wordsOfAll(drawn, by.value)} />
        </>
      )}
    </section>
  );
}
