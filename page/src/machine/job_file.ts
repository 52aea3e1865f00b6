// A job file of the daemon: its text, and its operations as a list. Each edit changes only the lines that it names.
import { signal } from '@preact/signals';
import { attempt } from '../core/notices';
import { get, post, Refused, type Finding } from './api';
import { cam, sendDrawing } from './cam';

export type Value = string | number | boolean | null | Value[];
export interface JobOperation {
  line: number; // of its head
  values: Record<string, Value>;
  lines: Record<string, number>; // of the keys
}
export interface JobTool {
  number: number;
  words: string;
  shape: string;
}
export interface JobFile {
  name: string;
  stamp: string;
  text: string;
  editable: boolean; // the text is TOML
  good: boolean;
  findings: Finding[];
  job: Record<string, Value> | null;
  stock: Record<string, Value> | null;
  nest: Record<string, Value> | null;
  clamps: Record<string, Value>[];
  clamp_paths: string[]; // of these: "clamp.1", "fixture.1"
  tool_tables: Record<string, Record<string, Value>> | null; // the job's own tools, by their numbers
  tools: JobTool[];
  operations: JobOperation[];
}
export type Edit =
  | { do: 'set'; path: string; value: Value }
  | { do: 'unset'; path: string }
  | { do: 'insert'; list?: string; number: number; values: Record<string, Value> }
  | { do: 'copy' | 'remove'; list?: string; number: number }
  | { do: 'remove'; path: string } // a table: "tool.3"
  | { do: 'move'; list?: string; number: number; to: number };

// What the record of a job tells of an operation. Operations are in the order in which they are cut.
export interface CutOperation {
  title: string;
  kind: string;
  written: number; // its number in the file, from 1
  line: number; // of its kind
  depth_mm: number;
  cut_s: number;
  rapid_mm: number;
  reason: string; // why it was moved; empty: it was not
  stock_left_mm3?: number;
  stock_left_percent?: number;
}
export interface JobReport {
  operations: CutOperation[];
  total_s: number;
  tool_changes: number;
}

export const jobFile = signal<JobFile | null>(null);
// Texts before the edits, for Undo.
export const past = signal<readonly string[]>([]);
const mostPast = 100;

export async function openJobFile(name: string): Promise<void> {
  await attempt(async () => {
    const file = await get<JobFile>(`/cam/job?name=${encodeURIComponent(name)}`);
    if (jobFile.value?.name !== name) past.value = [];
    jobFile.value = file;
  });
}

// One edit after the other: each begins with the text that the one before has left.
let last: Promise<unknown> = Promise.resolve();
function change(what: (file: JobFile) => object, keepsPast: boolean): Promise<boolean> {
  const next = last.then(() =>
    attempt(async () => {
      const file = jobFile.value;
      if (file === null) return;
      const changed = await post<JobFile>('/cam/job', { name: file.name, stamp: file.stamp, ...what(file) }).catch(async (error: unknown) => {
        // Somebody else has edited it: what they have made of it is shown.
        if (error instanceof Refused && error.code === 'make.job-changed') {
          past.value = [];
          await openJobFile(file.name);
        }
        throw error;
      });
      if (keepsPast && changed.text !== file.text) past.value = [...past.value, file.text].slice(-mostPast);
      jobFile.value = changed;
    }),
  );
  last = next;
  return next;
}
export const edit = (...edits: Edit[]): Promise<boolean> => change(() => ({ edits }), true);
export const replaceText = (text: string): Promise<boolean> => change(() => ({ text }), true);
export async function undo(): Promise<void> {
  const text = past.value.at(-1);
  if (text === undefined) return;
  if (await change(() => ({ text }), false)) past.value = past.value.slice(0, -1);
}

export interface Shape {
  layer: string;
  color: string; // "#ff0000"; empty: the drawing has no colours
  names: string[]; // ids and labels, of its groups too
  d: string; // in mm, Y up
  closed: boolean;
}
export interface ShapesOfDrawing {
  layers: string[];
  shapes: Shape[];
  box: number[]; // X, Y, X, Y; empty: nothing is drawn
  left_out: number;
}
// By the names of the drawings. A text: why a drawing cannot be read.
export const shapes = signal<Readonly<Record<string, ShapesOfDrawing | string>>>({});
const asked = new Set<string>();
const lookEvery = 100; // ms

export function forgetShapes(name?: string): void {
  const { [name ?? '']: _, ...others } = shapes.value;
  shapes.value = name === undefined ? {} : others;
}

export async function needShapes(name: string): Promise<void> {
  // It may have been removed.
  const isSent = (): boolean => cam.value?.files.includes(name) === true;
  if (shapes.value[name] !== undefined || asked.has(name) || !isSent()) return;
  asked.add(name);
  await attempt(async () => {
    while (isSent()) {
      type Answer = { state: string; drawing: ShapesOfDrawing | null; words: string };
      const now = await get<Answer>(`/cam/shapes?name=${encodeURIComponent(name)}`);
      if (now.state !== 'running') {
        shapes.value = { ...shapes.value, [name]: now.drawing ?? now.words };
        return;
      }
      await new Promise((resolve) => setTimeout(resolve, lookEvery));
    }
  });
  asked.delete(name);
}

const rounded = (mm: number): number => Number(mm.toFixed(3));
const quoted = (text: string): string => JSON.stringify(text);

// A job with one operation on all of a drawing. The stock is larger than the drawing on each side.
export async function newJobFile(drawing: string, taken: readonly string[]): Promise<void> {
  await needShapes(drawing);
  const read = shapes.value[drawing];
  const [x0, y0, x1, y1] = typeof read === 'object' && read.box.length === 4 ? (read.box as [number, number, number, number]) : [0, 0, 100, 100];
  const stem = drawing.replace(/\.[^.]*$/, '');
  let name = `${stem}.toml`;
  for (let i = 2; taken.includes(name); ++i) name = `${stem}-${i}.toml`;
  const edge = 10;
  const text = `# Made from ${drawing.replace(/[^\x20-\x7e]/g, '?')}.
[job]
drawing = ${quoted(drawing)}
zero = "lower-left"

[stock]
size = [${rounded(x1 - x0 + 2 * edge)}, ${rounded(y1 - y0 + 2 * edge)}]
corner = [${-edge}, ${-edge}]
thickness = 10

[tool.1]
shape = "flat"
diameter_mm = 3
feed_mm_min = 800
plunge_mm_min = 200
spindle_rpm = 16000

[[operation]]
kind = "profile"
tool = 1
depth = -2
step = 1
`;
  await sendDrawing(new File([text], name));
  await openJobFile(name);
}
