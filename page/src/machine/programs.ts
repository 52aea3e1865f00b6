// The programs that the daemon has, and the one that this page shows: the job's, else the chosen one, else the newest.
import { computed, effect, signal } from '@preact/signals';
import type { Program } from './api';
import { get, post, remove, upload } from './api';
import { isLive, status } from './connection';
import type { PathIndex } from './path_index';
import { consoleName, isUnderWay } from './words';

export const programs = signal<Program[]>([]);
export const chosen = signal<number | null>(null);
// What is open stays open over a reload of the tab. The daemon begins to count anew when it starts: so the name counts, too.
const openPlace = 'passo.open-program';
export function rememberOpenProgram(): void {
  try {
    const before: unknown = JSON.parse(sessionStorage.getItem(openPlace) ?? 'null');
    if (isOpen(before)) opened = before;
    effect(() => {
      const now = programs.value.find((one) => one.id === chosen.value);
      if (now !== undefined) sessionStorage.setItem(openPlace, JSON.stringify({ id: now.id, name: now.name }));
    });
  } catch {
    // Then a reload opens the newest one.
  }
}
interface Open {
  id: number;
  name: string;
}
const isOpen = (value: unknown): value is Open => typeof value === 'object' && value !== null && 'id' in value && 'name' in value;
let opened: Open | null = null;

// Once the programs are known.
export function reopen(all: readonly Program[], before: Open | null): void {
  if (before !== null && chosen.value === null) chosen.value = all.find((one) => one.id === before.id && one.name === before.name)?.id ?? null;
}
export const sending = signal<string | null>(null);
// Lines that the console runs are programs too, and so is the set-up mode of the outputs; nobody wants to see them in a
// list.
export const setUpName = 'set-up.ngc';
export const isListed = (program: Program): boolean => !program.small && program.name !== consoleName && program.name !== setUpName;

// What a probing cycle runs. A height map without a program stays with its own cycle.
export const isProbing = (program: Program): boolean => /^probe (surface|edge|corner|bore|boss|tool|angle|bores|map)$/.test(program.name);

// s; until the motion is planned, at the programmed speeds.
export const timeOf = (program: Program): number => program.planned ?? program.seconds;

const jobProgram = computed(() => {
  const job = status.value?.job ?? null;
  return isUnderWay(job) ? (job?.program ?? null) : null;
});
export const shownId = computed<number | null>(() => {
  const all = programs.value.filter(isListed);
  const has = (id: number | null): boolean => id !== null && all.some((one) => one.id === id);
  if (has(jobProgram.value)) return jobProgram.value;
  if (has(chosen.value)) return chosen.value;
  return all.at(-1)?.id ?? null;
});

// The program that a height map is for: never a probing cycle that has just ended, and is still shown.
export function mapTarget(all: readonly Program[], shownOne: number | null, chosenOne: number | null): Program | null {
  const own = all.filter((one) => isListed(one) && !isProbing(one));
  return own.find((one) => one.id === shownOne) ?? own.find((one) => one.id === chosenOne) ?? own.at(-1) ?? null;
}
export const programForMap = computed(() => mapTarget(programs.value, shownId.value, chosen.value));

// With its findings, which the list does not have.
export const shown = signal<Program | null>(null);

let refreshing = false;
let again = false;

export async function refreshPrograms(): Promise<void> {
  if (refreshing) {
    again = true;
    return;
  }
  refreshing = true;
  try {
    const all = (await get<{ programs: Program[] }>('/programs')).programs;
    reopen(all, opened);
    opened = null;
    programs.value = all;
    const id = shownId.value;
    shown.value = id === null ? null : await get<Program>(`/programs/${id}`);
  } catch {
    // The next time may be better; a lost connection is told elsewhere.
  } finally {
    refreshing = false;
  }
  if (again) {
    again = false;
    await refreshPrograms();
  }
}

export async function sendProgram(file: File): Promise<void> {
  sending.value = file.name;
  try {
    const program = await upload<Program>('/programs', file.name, file);
    chosen.value = program.id;
    await post(`/programs/${program.id}/check`);
    await refreshPrograms();
  } finally {
    sending.value = null;
  }
}

export async function checkProgram(id: number): Promise<void> {
  await post(`/programs/${id}/check`);
  await refreshPrograms();
}

// Checked from where the machine stands now: where the tool has been moved since, a program of relative moves goes elsewhere.
// Null: the program is not good, or somebody has had another one checked meanwhile.
export async function checkedFromHere(id: number): Promise<PathIndex | null> {
  await post(`/programs/${id}/check`);
  await refreshPrograms();
  for (;;) {
    const index = await get<PathIndex>(`/programs/${id}/path`);
    if (index.complete || !index.growing) {
      await refreshPrograms();
      const state = programs.value.find((one) => one.id === id)?.state;
      // The tool changes of a program are checked after its toolpath.
      if (state !== 'checking') return index.complete && state === 'good' ? index : null;
    }
    await new Promise((resolve) => setTimeout(resolve, whileChecking));
  }
}

// Lines that begin with /.
export async function leaveOut(program: Program, on: boolean): Promise<void> {
  await post(`/programs/${program.id}/block-delete`, { on });
  await checkProgram(program.id);
}

export async function deleteProgram(id: number): Promise<void> {
  await remove(`/programs/${id}`);
  await refreshPrograms();
}

const whileChecking = 150; // ms
const whileTiming = 500;
const otherwise = 4000;

export function followPrograms(): void {
  // A job that begins or ends, and a connection that comes back, change the list.
  const affects = computed(() => (isLive.value ? `${status.value?.job?.id} ${status.value?.job?.state} ${shownId.value}` : ''));
  effect(() => {
    if (affects.value !== '') void refreshPrograms();
  });
  // While a check goes on, its end is seen at once; and soon, how long the motion takes. Who loads the shown program's
  // path sees the end of its check by itself (scene/path_loader.ts).
  const pause = computed(() => {
    if (programs.value.some((one) => one.state === 'checking' && one.id !== shownId.value)) return whileChecking;
    if (shown.value?.state === 'checking') return whileTiming;
    return shown.value?.state === 'good' && shown.value.planned === null ? whileTiming : otherwise;
  });
  effect(() => {
    const timer = setInterval(
      () => {
        if (isLive.peek() && !document.hidden) void refreshPrograms();
      },
      pause.value,
    );
    return () => clearInterval(timer);
  });
}
