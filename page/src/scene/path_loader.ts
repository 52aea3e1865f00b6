// Gets the shown program's path from the daemon: coarse first for a long one, finer where somebody looks closer.
import { batch, effect } from '@preact/signals';
import { ask, get, post, type Program } from '../machine/api';
import { isLive, status } from '../machine/connection';
import { pathIndex, pathLoaded, type PathIndex } from '../machine/path_index';
import { refreshPrograms, shown } from '../machine/programs';
import { readChunks, type PathPoints } from './path_data';

const fewPoints = 80_000; // so many are shown without a coarse level
const atOnce = 4; // requests
const anAnswer = 4; // chunks; more would keep the daemon too long
const finest = 0;
const coarse = 1;
const whileGrowing = 100; // ms
const mostUnfinished = 0.99;
// How far a level may be from the path, as a share of the box's diagonal; as the daemon has it.
const farOff = [0, 1 / 4000, 1 / 800];

export interface PathListener {
  cleared: () => void;
  added: (points: PathPoints) => void;
}

// Where chunks come from: so many from the first on, one after the other.
export type PathSource = (index: PathIndex, first: number, count: number, level: number) => Promise<ArrayBuffer>;
const fromDaemon: PathSource = async (index, first, count, level) => {
  const path = `/programs/${index.program}/path?chunk=${first}&count=${count}&level=${level}`;
  return (await ask('GET', path, undefined, 20_000)).arrayBuffer();
};
let source = fromDaemon;

const listeners = new Set<PathListener>();
const chunks = new Map<string, PathPoints>();
const wanted = new Set<string>();
let round = 0; // of loading; what belongs to an earlier one is dropped

export const loadedChunks = (): Iterable<PathPoints> => chunks.values();
export const baseLevel = (index: PathIndex): number => (index.points <= fewPoints ? finest : coarse);

// The finest loaded points of each chunk.
export function finestChunks(): PathPoints[] {
  const best = new Map<number, PathPoints>();
  for (const one of chunks.values()) {
    const before = best.get(one.chunk);
    if (before === undefined || one.level < before.level) best.set(one.chunk, one);
  }
  return [...best.values()].sort((a, b) => a.chunk - b.chunk);
}

// The points that are always loaded, in their order.
export function baseChunks(): PathPoints[] {
  const index = pathIndex.peek();
  if (index === null) return [];
  const level = baseLevel(index);
  return [...chunks.values()].filter((one) => one.level === level).sort((a, b) => a.chunk - b.chunk);
}

// The coarsest level that is nowhere half a pixel off.
export function levelFor(index: PathIndex, mmAPixel: number): number {
  const box = index.all;
  if (box === null || baseLevel(index) === finest) return finest;
  const diagonal = Math.hypot(...box.high.map((high, k) => high - box.low[k]!));
  return diagonal * farOff[coarse]! <= mmAPixel * 0.6 ? coarse : finest;
}

// Neighbouring chunks that nobody has asked for yet, a few at a time.
function runsOf(all: readonly number[], level: number): number[][] {
  const runs: number[][] = [];
  for (const chunk of all) {
    const last = runs.at(-1);
    if (wanted.has(`${chunk}/${level}`)) continue;
    if (last !== undefined && last.length < anAnswer && last.at(-1) === chunk - 1) last.push(chunk);
    else runs.push([chunk]);
  }
  return runs;
}

async function fetchRun(index: PathIndex, run: readonly number[], level: number, mine: number): Promise<void> {
  for (const chunk of run) wanted.add(`${chunk}/${level}`);
  try {
    const answer = readChunks(await source(index, run[0]!, run.length, level));
    if (mine !== round) return;
    for (const points of answer) {
      chunks.set(`${points.chunk}/${points.level}`, points);
      for (const one of listeners) one.added(points);
    }
  } catch {
    for (const chunk of run) wanted.delete(`${chunk}/${level}`);
  }
}

async function fetchAll(index: PathIndex, all: readonly number[], level: number, tell: boolean): Promise<void> {
  const mine = round;
  const runs = runsOf(all, level);
  let next = 0;
  let done = 0;
  const work = async (): Promise<void> => {
    while (next < runs.length && mine === round) {
      await fetchRun(index, runs[next++]!, level, mine);
      ++done;
      if (tell && mine === round) pathLoaded.value = done / runs.length;
    }
  };
  await Promise.all(Array.from({ length: atOnce }, work));
  if (tell && mine === round) pathLoaded.value = 1;
}

// Somebody looks closer at these chunks.
export function wantFine(these: readonly number[]): void {
  const index = pathIndex.value;
  if (index !== null) void fetchAll(index, these, finest, false);
}

// A long program is seen while it is checked, as far as the check has come. Before its first points are there, the path
// of before stays.
export async function loadPath(program: Program): Promise<void> {
  const mine = ++round;
  let checks: number | null = null;
  for (;;) {
    const index = await get<PathIndex>(`/programs/${program.id}/path`);
    if (mine !== round || (checks !== null && index.checks !== checks)) return; // another check: it is loaded by itself
    if (!index.complete && !index.growing) return checks === null ? checkAgain(program.id) : undefined;
    if (index.complete || (program.lines > fewPoints && index.chunks > 0)) {
      if (checks === null) clear();
      checks = index.checks;
      await take(index, program.lines);
    }
    if (mine !== round) return;
    if (index.complete) return program.state === 'checking' ? refreshPrograms() : undefined;
    await new Promise((done) => setTimeout(done, whileGrowing));
  }
}

// What has come of the path since the last time. Less than 1 is loaded until the check has ended.
async function take(index: PathIndex, lines: number): Promise<void> {
  const whole = index.complete;
  batch(() => {
    pathIndex.value = index;
    pathLoaded.value = whole && index.chunks === 0 ? 1 : Math.min(mostUnfinished, index.points / lines);
  });
  const all = Array.from({ length: index.chunks }, (_, i) => i);
  await fetchAll(index, all, whole ? baseLevel(index) : coarse, whole);
}

// The daemon has let the path go, for want of room: a check brings it back.
async function checkAgain(program: number): Promise<void> {
  if (status.peek()?.state === 'Idle') await post(`/programs/${program}/check`);
}

function clear(): void {
  chunks.clear();
  wanted.clear();
  pathIndex.value = null;
  pathLoaded.value = 1;
  for (const one of listeners) one.cleared();
}

// A path that is whole, from somewhere else than the daemon. Null: none any more.
export async function showPath(index: PathIndex | null, from: PathSource): Promise<void> {
  ++round;
  clear();
  source = from;
  if (index !== null) await take(index, Math.max(1, index.points));
}

export function listenToPath(listener: PathListener): () => void {
  listeners.add(listener);
  for (const one of chunks.values()) listener.added(one);
  return () => listeners.delete(listener);
}

// Loads the path of the shown program whenever another one is shown, or the same is checked again.
export function followPath(): void {
  let told = '';
  effect(() => {
    const program = shown.value;
    const isUnchecked = program?.state === 'unchecked';
    const now = program === null || !isLive.value ? '' : `${program.id} ${program.checks} ${isUnchecked}`;
    if (now === told) return;
    told = now;
    if (program === null) {
      ++round;
      clear();
    } else if (isUnchecked) {
      void checkAgain(program.id).catch(() => undefined);
    } else if (now !== '') {
      loadPath(program).catch(() => (told = ''));
    }
  });
}
