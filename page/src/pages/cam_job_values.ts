// The keys of an operation as a form has them: what a value of the file looks like in a field, and what a field means.
import type { CamOption } from '../machine/cam';
import type { JobFile, JobOperation, Shape, Value } from '../machine/job_file';

// "10, 0" of [10, 0], and "10, 0; 40, 0" of a list of lists.
export function textOf(value: Value | undefined): string {
  if (value === undefined || value === null || typeof value === 'boolean') return '';
  if (!Array.isArray(value)) return String(value);
  return value.some(Array.isArray) ? value.map(textOf).join('; ') : value.map(String).join(', ');
}

const number = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const plain = (text: string): Value => (number.test(text) ? Number(text) : text);
const pieces = (text: string, by: string): string[] => text.split(by).map((one) => one.trim()).filter((one) => one !== '');

// Undefined: the key is not to be in the file. Bare numbers are in the unit of the job.
export function valueOf(row: CamOption | undefined, text: string): Value | undefined {
  const typed = text.trim();
  if (typed === '') return undefined;
  const isList = Array.isArray(row?.type) && row.type.includes('array');
  const kind = row?.['x-kind'] ?? 'text';
  if (kind === 'text' && !isList) return typed;
  if (typed.includes(';')) return pieces(typed, ';').map((one) => pieces(one, ',').map(plain));
  const all = pieces(typed, ',').map(plain);
  if (kind === 'text') return all.length === 1 ? String(all[0]) : all.map(String);
  const areNumbers = all.every((one) => typeof one === 'number');
  return all.length === 1 ? all[0] : areNumbers || isList ? all : typed;
}

export const selectors = ['layer', 'color', 'name'] as const;
export type Selector = (typeof selectors)[number];
export const wanted = (operation: JobOperation, by: Selector): string[] => {
  const value = operation.values[by];
  return value === undefined || value === null ? [] : Array.isArray(value) ? value.map(String) : [String(value)];
};
export const wordsOf = (shape: Shape, by: Selector): string[] => (by === 'name' ? shape.names : [shape[by]].filter((one) => one !== ''));

const usual: Record<string, string> = { black: '#000000', white: '#ffffff', red: '#ff0000', lime: '#00ff00', green: '#008000', blue: '#0000ff', yellow: '#ffff00', cyan: '#00ffff', magenta: '#ff00ff', orange: '#ffa500', gray: '#808080', grey: '#808080' };
const colour = (text: string): string => {
  const small = text.trim().toLowerCase();
  return usual[small] ?? small.replace(/^#([0-9a-f])([0-9a-f])([0-9a-f])$/, '#$1$1$2$2$3$3');
};

// Whether an operation cuts a shape, as the server selects it.
export function selects(operation: JobOperation, shape: Shape): boolean {
  const [layers, colors, names] = [wanted(operation, 'layer'), wanted(operation, 'color'), wanted(operation, 'name')];
  return (
    (layers.length === 0 || layers.includes(shape.layer)) &&
    (colors.length === 0 || colors.map(colour).includes(shape.color)) &&
    (names.length === 0 || names.some((one) => shape.names.includes(one)))
  );
}

// The drawings that an operation cuts.
export function drawingsOf(file: JobFile, operation?: JobOperation): string[] {
  const own = operation?.values.drawing ?? file.job?.drawing;
  return typeof own === 'string' ? [own] : Array.isArray(own) ? own.map(String) : [];
}

// The drawings of a job without one, or with one more. Undefined: it has none.
export function withDrawing(all: readonly string[], name: string, has: boolean): Value | undefined {
  const now = has ? [...all.filter((one) => one !== name), name] : all.filter((one) => one !== name);
  return now.length === 0 ? undefined : now.length === 1 ? now[0] : now;
}

// The operations that cut with a tool, counted from 1. `keys`: those of an operation that name a tool.
export const usersOf = (file: JobFile, tool: number, keys: readonly string[]): number[] =>
  file.operations.flatMap(({ values }, index) => (keys.some((key) => Number(values[key]) === tool) ? [index + 1] : []));

// The findings of an operation: those in its lines. The others are of the file.
export function findingsOf(file: JobFile, index: number): JobFile['findings'] {
  return file.findings.filter((finding) => ownerOf(file, finding.line) === index);
}
export function ownerOf(file: JobFile, line: number): number {
  let owner = -1;
  file.operations.forEach((operation, index) => {
    if (line >= operation.line && line <= Math.max(operation.line, ...Object.values(operation.lines))) owner = index;
  });
  return owner;
}
