// The settings of the Grbl board, as last read, and what a person has typed since. The server writes them one by one, and
// tells what has become of each.
import { computed, signal } from '@preact/signals';
import { attempt } from '../core/notices';
import { ask, get, post } from './api';
import { beOwner } from './owner';

export interface Setting {
  name: string; // "$110"
  value: string;
  title: string;
  unit: string;
  group: string;
  meaning: string;
  kind: 'unknown' | 'number' | 'integer' | 'flag' | 'bits' | 'axes' | 'choice' | 'text' | 'password';
  least: number | null;
  most: number | null;
  zero_too: boolean; // 0 is allowed below the least value
  choices: string[];
  needs_restart: boolean;
  read_only: boolean;
}
export interface Change {
  name: string;
  before: string;
  wanted: string;
  value: string;
  written: boolean;
  trouble: string;
  also: string[];
}
export interface Difference {
  name: string;
  file: string;
  board: string;
}
interface Told {
  has_board: boolean;
  state: 'none' | 'running' | 'done' | 'failed';
  board: string;
  words: string;
  report: { firmware: string; version: string; settings: Setting[]; changes: Change[]; differences?: Difference[] } | null;
}
type Order = { order: 'read' } | { order: 'write'; values: Record<string, string> } | { order: 'compare' | 'restore'; file: string };

const lookEvery = 200; // ms

export const told = signal<Told | null>(null);
export const edits = signal<Record<string, string>>({});
export const settings = computed(() => told.value?.report?.settings ?? []);
export const isWorking = computed(() => told.value?.state === 'running');
export const edited = computed(() =>
  settings.value.filter((one) => edits.value[one.name] !== undefined && edits.value[one.name] !== one.value),
);

async function follow(): Promise<void> {
  while (told.value?.state === 'running') {
    await new Promise((resolve) => setTimeout(resolve, lookEvery));
    told.value = await get<Told>('/board/settings');
  }
}

export async function learnSettings(): Promise<void> {
  await attempt(async () => {
    told.value = await get<Told>('/board/settings');
    await follow();
  });
}

async function order(wanted: Order): Promise<boolean> {
  return attempt(async () => {
    await beOwner();
    told.value = await post<Told>('/board/settings', wanted);
    await follow();
  });
}

export async function readSettings(): Promise<void> {
  if (await order({ order: 'read' })) edits.value = {};
}
// What the board has refused stays as it was typed, to be corrected.
export async function writeEdits(): Promise<void> {
  const values = Object.fromEntries(edited.value.map((one) => [one.name, edits.value[one.name] ?? one.value]));
  if (!(await order({ order: 'write', values }))) return;
  const refused = new Set((told.value?.report?.changes ?? []).filter((one) => !one.written).map((one) => one.name));
  edits.value = Object.fromEntries(Object.entries(edits.value).filter(([name]) => refused.has(name)));
}
export async function compareWith(file: string): Promise<Difference[] | null> {
  const done = await order({ order: 'compare', file });
  return done ? (told.value?.report?.differences ?? null) : null;
}
export const restoreFrom = (file: string): Promise<boolean> => order({ order: 'restore', file });
export const settingsFile = async (): Promise<string> => (await ask('GET', '/board/settings/file')).text();

export function edit(name: string, value: string): void {
  edits.value = { ...edits.value, [name]: value };
}
export function forgetEdits(): void {
  edits.value = {};
}

// Settings that have all the words, in any order and case.
export function sought(all: readonly Setting[], text: string): Setting[] {
  const words = text.toLowerCase().split(/\s+/).filter((word) => word !== '');
  return all.filter((one) => words.every((word) => `${one.name} ${one.title} ${one.group} ${one.meaning} ${one.unit}`.toLowerCase().includes(word)));
}
// In the order of the board; settings of a group stay together.
export function byGroup(all: readonly Setting[]): [string, Setting[]][] {
  const groups = new Map<string, Setting[]>();
  for (const one of all) groups.set(one.group, [...(groups.get(one.group) ?? []), one]);
  return [...groups];
}
// "0.1 … 200", or a bound alone.
export function rangeOf({ least, most, zero_too: zeroToo }: Setting): string {
  if (least === null && most === null) return '';
  const words = least !== null && most !== null ? `${least} … ${most}` : least !== null ? `≥ ${least}` : `≤ ${most}`;
  return zeroToo ? `0, ${words}` : words;
}
// Boards write ASCII: "us", "microseconds", "mm/sec^2".
export const unitOf = ({ unit }: Setting): string =>
  unit.replace(/^(us|microseconds)$/i, 'µs').replace(/^milliseconds$/i, 'ms').replace(/^seconds$/i, 's').replace(/sec\b/, 's').replace('^2', '²').replace('^3', '³');
// A sum of bits, with one of them changed.
export function withBit(value: string, bit: number, on: boolean): string {
  const sum = Number(value);
  const whole = Number.isInteger(sum) && sum >= 0 && sum < 65536 ? sum : 0;
  return String(on ? whole | (1 << bit) : whole & ~(1 << bit));
}
export const hasBit = (value: string, bit: number): boolean => (Number(value) & (1 << bit)) !== 0;
