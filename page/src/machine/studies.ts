// What the daemon works out beside the machine: the torque that each line of a program needs, and proposals for a program
// that does not run (as `passo check`), and limits for the motors (as `passo tune`).
import { computed, effect, signal } from '@preact/signals';
import { attempt } from '../core/notices';
import type { Program } from './api';
import { ask, get, post } from './api';
import { isLive } from './connection';
import { shown } from './programs';

export type Verdict = 'safe' | 'doubtful' | 'lost';
export interface LoadedLine {
  line: number;
  axis: string;
  verdict: Verdict;
  want: 'torque' | 'jump' | 'calm';
  needed_nm: number;
  low_nm: number;
  full_steps_s: number;
  // What would be safe; of a rapid, the velocity of its axis too. Lengths are mm, or degrees.
  safe_acceleration?: number;
  safe_feed_mm_min?: number;
  safe_velocity_mm_min?: number;
}
export interface Tuning {
  verdict: Verdict;
  axes: { axis: string; velocity: number; acceleration: number; jerk: number; bound: string; ringing_hz: number; way: number; time_s: number }[];
  values: { key: string; before: number; after: number }[];
}
// With what a program would run that does not, or not well. `words` are English; the values are for words in other languages.
export type Proposal = { words: string } & (
  | { kind: 'work-zero'; zeros: Record<string, Record<string, number>> } // machine coordinates, by work coordinate system and axis
  | { kind: 'axis-too-short'; axis: string; needed: number; travel: number }
  | { kind: 'tools'; tools: number[] }
  | { kind: 'spindle-speed'; spindle_rpm: number; feed_percent: number }
  | { kind: 'override'; feed_percent: number; rapid_percent: number }
);
interface MotorsReport {
  proposals: Proposal[];
  margin: { verdict: Verdict; worst_lines: LoadedLine[] } | null;
}
interface Study<Report> {
  study: string;
  program: number | null;
  state: 'none' | 'running' | 'done' | 'failed';
  words: string;
  report: Report | null;
}

const lookEvery = 200; // ms
let turn = 0; // a later order takes the place of an earlier one

// Null: a later order has taken its place.
async function study<Report>(order: object): Promise<Study<Report> | null> {
  const mine = ++turn;
  let now = await post<Study<Report>>('/study', order);
  while (now.state === 'running') {
    await new Promise((resolve) => setTimeout(resolve, lookEvery));
    if (mine !== turn) return null;
    now = await get<Study<Report>>('/study');
  }
  return mine === turn ? now : null;
}

// --- the torque that a program needs ---

export interface MotorLoads {
  key: string; // of the program as it was checked
  state: 'running' | 'done' | 'failed' | 'unknown'; // unknown: the machine file describes no motor
  words: string;
  verdict: Verdict;
  worst: LoadedLine[];
  most: number; // the share of the sure torque that the worst line needs
  // By line: the share, in 1/100 from 1 on; 0: the line does not move.
  lines: Uint16Array;
}
export const motorLoads = signal<MotorLoads | null>(null);
const none = new Uint16Array(0);

export function readLoads(csv: string): Uint16Array {
  const rows = csv.trimEnd().split('\n').slice(1);
  const last = rows.at(-1) ?? '0';
  const lines = new Uint16Array(parseInt(last, 10) + 1);
  for (const row of rows) {
    const comma = row.indexOf(',');
    if (comma > 0) lines[parseInt(row, 10)] = 1 + Math.min(60_000, Math.round(100 * Number(row.slice(comma + 1))));
  }
  return lines;
}

// A program that is bad may be good after the next check: with another zero, or more tools.
const keyOf = (program: Program): string =>
  `${program.id} ${program.moves} ${program.seconds} ${program.state === 'bad' ? program.checks : ''}`;
const proposed = signal<{ key: string; proposals: Proposal[] } | null>(null);
export const proposalsFor = (program: Program): Proposal[] => (proposed.value?.key === keyOf(program) ? proposed.value.proposals : []);
const moreLines = 2_000_000; // beyond, nobody waits for it

async function askLoads(program: Program): Promise<void> {
  const key = keyOf(program);
  const moves = program.state === 'good'; // a bad one has no load, but perhaps proposals
  proposed.value = { key, proposals: [] };
  motorLoads.value = moves ? { key, state: 'running', words: '', verdict: 'safe', worst: [], most: 0, lines: none } : null;
  const found = await study<MotorsReport>({ study: 'motors', program: program.id });
  if (found === null) {
    if (motorLoads.value?.key === key) motorLoads.value = null;
    if (proposed.value?.key === key) proposed.value = null;
    return;
  }
  proposed.value = { key, proposals: found.report?.proposals ?? [] };
  if (!moves) return;
  const margin = found.report?.margin ?? null;
  const state = found.state === 'failed' ? 'failed' : margin === null ? 'unknown' : 'done';
  const lines = state === 'done' ? readLoads(await (await ask('GET', '/study/loads', undefined, 60_000)).text()) : none;
  const most = lines.reduce((sum, one) => Math.max(sum, one), 1) - 1;
  motorLoads.value = { key, state, words: found.words, verdict: margin?.verdict ?? 'safe', worst: margin?.worst_lines ?? [], most: most / 100, lines };
}

// Pages that show the torque want it as soon as the program is checked.
const wanting = signal(0);
export function wantLoads(): () => void {
  ++wanting.value;
  return () => void --wanting.value;
}
export const loadsOfShown = computed(() => {
  const program = shown.value;
  const loads = motorLoads.value;
  return program !== null && loads?.key === keyOf(program) ? loads : null;
});

export function followStudies(): void {
  effect(() => {
    const program = shown.value;
    if (wanting.value === 0 || !isLive.value || program === null || program.lines > moreLines) return;
    if ((program.state !== 'good' && program.state !== 'bad') || proposed.peek()?.key === keyOf(program)) return;
    void attempt(() => askLoads(program));
  });
}

// --- limits for the motors ---

// What GET /study/options says of the share of the torque that stays unused.
interface Margin {
  minimum: number;
  maximum: number;
  default: number;
}
export const marginRow = signal<Margin | null>(null);

// It does not change while the daemon runs.
export async function needStudyOptions(): Promise<void> {
  if (marginRow.value !== null) return;
  await attempt(async () => {
    marginRow.value = (await get<{ tune: { properties: { margin: Margin } } }>('/study/options')).tune.properties.margin;
  });
}

export const tuning = signal<{ state: 'running' | 'done' | 'failed'; words: string; report: Tuning | null } | null>(null);
// Counts the tunings, so that each has a picture of its own.
export const tunedCount = signal(0);

// Without a margin: the usual one.
export async function tune(machineText: string, margin?: number): Promise<void> {
  tuning.value = { state: 'running', words: '', report: null };
  const good = await attempt(async () => {
    const found = await study<Tuning>({ study: 'tune', machine: machineText, margin });
    if (found === null) return void (tuning.value = null);
    const done = found.state === 'done' && found.report !== null;
    ++tunedCount.value;
    tuning.value = { state: done ? 'done' : 'failed', words: found.words, report: found.report };
  });
  if (!good) tuning.value = null;
}
