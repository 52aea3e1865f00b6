// The probing cycles of the daemon: what each one asks for, and what it will do.
import { signal } from '@preact/signals';
import { attempt, notify } from '../core/notices';
import { kept } from '../core/kept';
import { confirm } from '../core/question';
import { language, say, type Key } from '../core/language';
import { lengthText, lengthUnit, speedText, speedUnit } from '../core/units';
import { reportWords } from '../core/faults';
import { get, post, type Program } from './api';
import { beOwner } from './owner';
import { placeWords, workPlace } from './place';
import { chosen, refreshPrograms } from './programs';

export const kinds = ['surface', 'edge', 'corner', 'bore', 'boss', 'tool', 'angle', 'bores', 'map'] as const;
export type Kind = (typeof kinds)[number];
type Measure = 'length' | 'speed' | 'count';
export interface Field {
  name: string;
  title: Key;
  measure: Measure;
  usual: number; // mm, mm/min
  low: number;
  high: number;
  of: readonly Kind[];
  rare?: boolean; // seldom changed
}
const sides: readonly Kind[] = ['edge', 'corner', 'bore', 'boss', 'bores'];
const twice: readonly Kind[] = kinds.filter((kind) => kind !== 'map');
const length = (name: string, title: Key, usual: number, low: number, high: number, of: readonly Kind[], rare = false): Field => ({
  name, title, measure: 'length', usual, low, high, of, rare,
}); // prettier-ignore
const count = (name: string, title: Key, usual: number, low: number, high: number, of: readonly Kind[], rare = false): Field => ({
  name, title, measure: 'count', usual, low, high, of, rare,
}); // prettier-ignore
const speed = (name: string, title: Key, usual: number, of: readonly Kind[]): Field => ({
  name, title, measure: 'speed', usual, low: 1, high: 10_000, of, rare: true,
}); // prettier-ignore
const far = 1e5;
// As the daemon knows them.
export const fields: readonly Field[] = [
  length('height', 'probe.height', 0, -1000, 1000, ['surface']),
  length('ball', 'probe.ball', 0, 0, 100, sides),
  length('size_x', 'probe.size.x', 20, 0.01, 10_000, ['boss', 'map']),
  length('size_y', 'probe.size.y', 20, 0.01, 10_000, ['boss', 'map']),
  length('along', 'probe.along', 20, 0.1, 10_000, ['angle']),
  length('x', 'probe.x', 0, -far, far, ['tool', 'bores', 'map']),
  length('y', 'probe.y', 0, -far, far, ['tool', 'bores', 'map']),
  length('second_x', 'probe.second.x', 50, -far, far, ['bores']),
  length('second_y', 'probe.second.y', 0, -far, far, ['bores']),
  count('columns', 'probe.columns', 5, 2, 200, ['map']),
  count('rows', 'probe.rows', 5, 2, 200, ['map']),
  count('tool', 'probe.tool.number', 1, 1, 99_999, ['tool']),
  length('travel_z', 'probe.travel.z', 0, -far, far, ['tool']),
  length('zero_z', 'probe.zero.z', 0, -far, far, ['tool']),
  length('depth', 'probe.depth', 3, 0.01, 1000, ['corner', 'boss', 'map']),
  length('inside', 'probe.inside', 10, 0.1, 1000, ['corner']),
  length('clearance', 'probe.clearance', 5, 0.1, 1000, kinds),
  length('reach', 'probe.reach', 25, 0.1, 1000, twice),
  length('back', 'probe.back', 1, 0.01, 100, twice, true),
  length('fit', 'probe.fit', 0.3, 0.001, 1000, ['bores'], true),
  speed('fast', 'probe.fast', 300, kinds),
  speed('slow', 'probe.slow', 30, twice),
  count('system', 'probe.system', 1, 1, 9, twice.filter((kind) => kind !== 'tool'), true),
];
export const fieldsOf = (kind: Kind): readonly Field[] => fields.filter((one) => one.of.includes(kind));

export const waysOf: Partial<Record<Kind, readonly string[]>> = {
  edge: ['x+', 'x-', 'y+', 'y-'],
  angle: ['x+', 'x-', 'y+', 'y-'],
  corner: ['front-left', 'front-right', 'back-left', 'back-right'],
};

export const kind = signal<Kind>('surface');
type Values = Record<string, number>;
const isTable = (value: unknown): value is Record<string, Values> => typeof value === 'object' && value !== null;
const filled = kept<Record<string, Values>>('probing', {}, isTable);
export const side = signal<Partial<Record<Kind, string>>>({});

export const sideOf = (of: Kind): string => side.value[of] ?? waysOf[of]?.[0] ?? '';
export const valueOf = (of: Kind, field: Field): number => filled.value[of]?.[field.name] ?? field.usual;
export const setValue = (of: Kind, field: Field, to: number): void => {
  filled.value = { ...filled.value, [of]: { ...filled.value[of], [field.name]: Math.min(field.high, Math.max(field.low, to)) } };
};
// All numbers of a cycle by name.
export const valuesOf = (of: Kind): Values => Object.fromEntries(fieldsOf(of).map((field) => [field.name, valueOf(of, field)]));

export function wordsOf(field: Field, value: number): string {
  if (field.measure === 'count') return String(value);
  return field.measure === 'speed' ? `${speedText(value)} ${speedUnit()}` : `${Number(lengthText(value, 4))} ${lengthUnit()}`;
}

// What the cycle does, step by step, with its figures.
export function stepsOf(of: Kind): string {
  const words = fieldsOf(of).map((field) => [field.name, wordsOf(field, valueOf(of, field))]);
  return say(`probe.${of}.steps`, Object.fromEntries(words));
}

export async function probe(of: Kind, target: Program | null): Promise<void> {
  const yes = await confirm({
    title: say('probe.ask', { cycle: say(`probe.${of}`) }),
    facts: [
      stepsOf(of),
      say('probe.from', { place: placeWords(workPlace.value), from: say(`probe.${of}.from`) }),
      say(`probe.${of}.sets`),
      ...(of === 'map' && target !== null ? [say('probe.map.for', { name: target.name })] : []),
      say('probe.nothing'),
    ],
    rows: fieldsOf(of).map((field) => [say(field.title), wordsOf(field, valueOf(of, field))]),
    yes: say('probe.begin'),
    kind: 'go',
  });
  if (!yes) return;
  await attempt(async () => {
    await beOwner();
    await post('/probe', {
      cycle: of,
      ...(sideOf(of) === '' ? {} : { side: sideOf(of) }),
      ...valuesOf(of),
      ...(of === 'map' && target !== null ? { program: target.id } : {}),
    });
  });
}

// --- the height map of a program ---

export interface HeightMap {
  columns: number[];
  rows: number[];
  heights: number[][]; // row by row
  lowest: number;
  highest: number;
  mean: number;
  rise_x: number; // mm a mm
  rise_y: number;
  off_plane: number;
}
export const heightMap = signal<{ program: number; map: HeightMap } | null>(null);

// A job may just have found one, so the daemon is asked, and not the list of programs.
let looks = 0; // an answer to an earlier look is dropped
export async function lookForMap(program: number | null): Promise<void> {
  const mine = ++looks;
  let found: { program: number; map: HeightMap } | null = null;
  try {
    const has = program !== null && (await get<Program>(`/programs/${program}`)).height_map;
    if (has) found = { program, map: await get<HeightMap>(`/programs/${program}/height-map`) };
  } catch {
    // The program has just been deleted.
  }
  if (mine === looks) heightMap.value = found;
}

export async function level(program: Program): Promise<void> {
  await attempt(async () => {
    const made = await post<Program>(`/programs/${program.id}/level`);
    for (const one of made.findings ?? []) notify('refused', `${say('run.line', { line: one.line })}: ${reportWords(one.message, one.message_sentence)}`);
    chosen.value = made.id;
    await post(`/programs/${made.id}/check`);
    await refreshPrograms();
  });
}
export const figure = (value: number): string => value.toLocaleString(language.value, { maximumFractionDigits: 3 });
