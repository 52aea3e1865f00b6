// The machine file in the editor: a text that is sound, the values that a person has changed since, and all steps back.
// The daemon says what a change makes of the text, and what is wrong with it.
import { computed, signal } from '@preact/signals';
import { attempt } from '../core/notices';
import { get, post, type Finding, type MachineAxis } from './api';
import { beOwner } from './owner';

export type Value = number | string | boolean | number[];
export type Values = Record<string, Value>;

export interface Draft {
  text: string;
  good: boolean;
  values: Values;
  axes: MachineAxis[];
  findings: Finding[];
}
export interface MachineFile extends Draft {
  name: string;
  stamp: string;
  in_force: boolean;
  writable: boolean;
}

interface Step {
  base: Draft; // a text that was loaded
  edits: Values;
  last: string; // the path of the last change
}

const mostSteps = 200;

export const file = signal<MachineFile | null>(null);
export const draft = signal<Draft | null>(null);
const steps = signal<Step[]>([]);

export const lastChanged = computed(() => steps.value.at(-1)?.last ?? '');
export const canUndo = computed(() => steps.value.length > 1);
export const isChanged = computed(() => draft.value !== null && file.value !== null && draft.value.text !== file.value.text);
// As typed, also where the daemon refuses them.
export const values = computed<Values>(() => {
  const step = steps.value.at(-1);
  return step === undefined ? {} : { ...step.base.values, ...step.edits };
});
// What would be written: old and new of each changed value.
export const changes = computed<[string, Value | undefined, Value][]>(() => {
  const before = file.value?.values ?? {};
  return Object.entries(values.value)
    .filter(([path, value]) => JSON.stringify(value) !== JSON.stringify(before[path]))
    .map(([path, value]) => [path, before[path], value]);
});

// Usual values of the work, as the file has them: undefined where it says nothing.
export const usualClearance = computed(() => usualOf('work.clearance_mm'));
export const usualDepth = computed(() => usualOf('work.depth_mm'));
function usualOf(path: string): number | undefined {
  const value = file.value?.values[path];
  return typeof value === 'number' ? value : undefined;
}
export async function needFile(): Promise<void> {
  if (file.peek() === null) await loadFile();
}

let asked = 0;

async function show(step: Step): Promise<void> {
  const mine = ++asked;
  const result = await post<Draft>('/machine/file/draft', { text: step.base.text, set: step.edits });
  if (mine === asked) draft.value = result;
}

export async function loadFile(): Promise<void> {
  await attempt(async () => {
    const told = await get<MachineFile>('/machine/file');
    ++asked;
    file.value = told;
    draft.value = told;
    steps.value = [{ base: told, edits: {}, last: '' }];
  });
}

function push(step: Step): Promise<boolean> {
  const before = steps.value;
  steps.value = [...before, step].slice(-mostSteps);
  return attempt(() => show(step)).then((done) => {
    if (!done && steps.value.at(-1) === step) steps.value = before;
    return done;
  });
}

export async function setValue(path: string, value: Value): Promise<void> {
  const now = steps.value.at(-1);
  if (now === undefined || JSON.stringify(values.value[path]) === JSON.stringify(value)) return;
  await push({ base: now.base, edits: { ...now.edits, [path]: value }, last: path });
}

// Several values in one step.
export async function setValues(all: Values): Promise<void> {
  const now = steps.value.at(-1);
  if (now !== undefined) await push({ base: now.base, edits: { ...now.edits, ...all }, last: '' });
}

export async function takeText(text: string): Promise<void> {
  await attempt(async () => {
    const base = await post<Draft>('/machine/file/draft', { text });
    await push({ base, edits: {}, last: '' });
  });
}

export async function undo(): Promise<void> {
  if (!canUndo.value) return;
  steps.value = steps.value.slice(0, -1);
  const now = steps.value.at(-1);
  if (now !== undefined) await attempt(() => show(now));
}

export async function writeFile(): Promise<boolean> {
  const now = draft.value;
  const before = file.value;
  if (now === null || before === null) return false;
  return attempt(async () => {
    await beOwner();
    const told = await post<MachineFile>('/machine/file', { text: now.text, stamp: before.stamp });
    file.value = told;
    draft.value = told;
    steps.value = [{ base: told, edits: {}, last: '' }];
  });
}

// How a motor and a screw make steps, and what a person is shown of it. Undefined: the file says too little.
export interface Scale {
  words: string; // "200 × 16 ÷ 5"
  steps: number; // a mm or a degree
}
export function scaleOf(all: Values, axis: string, rotary: boolean, shown: (mm: number) => string = String): Scale | undefined {
  const number = (key: string): number | undefined => {
    const value = all[`axis.${axis}.${key}`];
    return typeof value === 'number' ? value : undefined;
  };
  const given = number(rotary ? 'steps_per_deg' : 'steps_per_mm');
  if (given !== undefined) return { words: String(given), steps: given };
  const turn = number('steps_per_turn');
  const micro = number('microsteps') ?? 1;
  const way = number(rotary ? 'gear_ratio' : 'screw_pitch_mm');
  if (turn === undefined || way === undefined || way <= 0) return undefined;
  return rotary
    ? { words: `${turn} × ${micro} × ${way} ÷ 360`, steps: (turn * micro * way) / 360 }
    : { words: `${turn} × ${micro} ÷ ${shown(way)}`, steps: (turn * micro) / way };
}
