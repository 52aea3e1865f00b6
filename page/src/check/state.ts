// The visitor's choices, the running check and its results. None of it leaves this computer.
import { batch, computed, signal } from '@preact/signals';
import { machine as sceneMachine } from '../machine/connection';
import type { Machine } from '../machine/api';
import type { PathIndex } from '../machine/path_index';
import { showPath } from '../scene/path_loader';
import { picked } from '../scene/stage';
import type { CheckAnswer } from './answer';
import { exampleMachine, usualMachine, type ChosenMachine } from './examples';
import { FileText } from './file_text';
import type { Stage } from './host';
import { importMachine, isConfiguration, isSettingsDump } from './importing';
import type { CheckRequest, FromWorker, ToWorker } from './messages';
import workerAddress from './worker.ts?worker&url';
import { motorKeys, motorKinds, usualLoad, type MovedLoad } from './motors';

export const mostBytes = 200_000_000;

export const program = signal<File | null>(null);
export const otherFiles = signal<readonly File[]>([]); // subroutines and a tool table
export const chosenMachine = signal<ChosenMachine>(exampleMachine(usualMachine));
export const motor = signal(''); // of motorKinds; empty: as the machine file has it
export const load = signal<MovedLoad>(usualLoad);
export const dialect = signal<'linuxcnc' | 'grbl'>('linuxcnc');
export const inches = signal(false);
export const text = signal<FileText | null>(null);

export interface Running {
  stage: Stage;
  share: number;
  left: number | null; // s, of the stage
}
export type Refusal = 'too-large' | 'memory' | 'failed' | 'no-module' | 'empty' | 'cancelled' | 'other-file';
export const running = signal<Running | null>(null);
export const refusal = signal<{ kind: Refusal; words: string } | null>(null);
export const result = signal<{ answer: CheckAnswer; seconds: number; megabytes: number } | null>(null);
export const tools = computed(() => otherFiles.value.find((one) => /\.tbl$/i.test(one.name))?.name ?? '');

// The module and the worker's script are loaded once. After that the page fetches nothing.
let bytes: Promise<ArrayBuffer> | undefined;
let script = '';
async function fetched(address: URL | string): Promise<Response> {
  const reply = await fetch(address);
  if (!reply.ok) throw new Error(reply.statusText);
  return reply;
}
async function loadAll(): Promise<ArrayBuffer> {
  const [module, text] = await Promise.all([fetched(new URL('check.wasm', document.baseURI)), fetched(workerAddress)]);
  script = URL.createObjectURL(new Blob([await text.text()], { type: 'text/javascript' }));
  return module.arrayBuffer();
}
export function loadModule(): Promise<ArrayBuffer> {
  bytes ??= loadAll();
  bytes.catch(() => (bytes = undefined));
  return bytes;
}

let worker: Worker | undefined;
const waiting = new Map<number, (bytes: ArrayBuffer) => void>();
let question = 0;
const newWorker = (): Worker => new Worker(script, { type: 'module' });
const tell = (to: Worker, what: ToWorker): void => to.postMessage(what);

// Ends the check at once and frees its memory.
export function cancel(): void {
  end();
  refusal.value = { kind: 'cancelled', words: '' };
}
function end(): void {
  worker?.terminate();
  worker = undefined;
  waiting.clear();
  running.value = null;
}

function forget(): void {
  end();
  batch(() => {
    result.value = null;
    refusal.value = null;
    picked.value = null;
  });
  void showPath(null, () => Promise.reject(new Error('there is no path')));
}

const askPath = (first: number, count: number, level: number): Promise<ArrayBuffer> =>
  new Promise((done, fail) => {
    if (worker === undefined) return fail(new Error('the check has ended'));
    waiting.set(++question, done);
    tell(worker, { kind: 'path', id: question, first, count, level });
  });

// How long the stage still takes, once enough of it is done to tell.
function leftOf(begun: number, share: number): number | null {
  const spent = (performance.now() - begun) / 1000;
  return share < 0.02 || spent < 1 ? null : (spent / share) * (1 - share);
}

async function show(answer: CheckAnswer): Promise<void> {
  const machine = answer.machine;
  sceneMachine.value = {
    name: machine.name ?? '',
    axes: (machine.axes ?? []).map((one) => ({ axis: one.axis.toLowerCase(), low: one.travel[0], high: one.travel[1], speed: 0, homes: false })),
  } as unknown as Machine;
  const path = answer.path;
  if (path === undefined || path.points === 0) return;
  const index: PathIndex = { ...path, program: ++question, checks: 1, growing: false, complete: true, reach: null };
  await showPath(index, (_, first, count, level) => askPath(first, count, level));
}

export async function check(): Promise<void> {
  const file = program.peek();
  forget();
  if (file === null) return;
  if (file.size > mostBytes || file.size === 0) {
    refusal.value = { kind: file.size === 0 ? 'empty' : 'too-large', words: '' };
    return;
  }
  running.value = { stage: 'reading', share: 0, left: null };
  let module: ArrayBuffer;
  try {
    module = await loadModule();
  } catch (error) {
    running.value = null;
    refusal.value = { kind: 'no-module', words: String(error) };
    return;
  }
  const machine = chosenMachine.peek();
  const kind = motorKinds[motor.peek()];
  const request: CheckRequest = {
    program: file.name,
    machine: { name: machine.file, text: machine.text, motor: kind === undefined ? null : motorKeys(kind, load.peek()) },
    dialect: dialect.peek(),
    inches: inches.peek(),
    block_delete: false,
    tools: tools.peek(),
    proposals: file.size < mostProposed,
  };
  if (running.peek() === null) return; // cancelled
  worker = newWorker();
  const mine = worker;
  let begun = performance.now();
  let stage: Stage = 'reading';
  mine.onerror = () => fail(false, 'the worker has failed');
  mine.onmessage = ({ data }: MessageEvent<FromWorker>) => {
    if (mine !== worker) return;
    if (data.kind === 'progress') {
      if (data.stage !== stage) begun = performance.now();
      stage = data.stage;
      running.value = { stage, share: data.share, left: leftOf(begun, data.share) };
    } else if (data.kind === 'done') {
      const answer = JSON.parse(data.answer) as CheckAnswer;
      batch(() => {
        running.value = null;
        result.value = { answer, seconds: data.milliseconds / 1000, megabytes: data.bytes / 2 ** 20 };
      });
      void show(answer);
    } else if (data.kind === 'path') {
      waiting.get(data.id)?.(data.bytes);
      waiting.delete(data.id);
    } else if (data.kind === 'failed') {
      fail(data.memory, data.words);
    }
  };
  tell(mine, { kind: 'check', module, files: [file, ...otherFiles.peek()], request });
}
const mostProposed = 20_000_000; // bytes; for larger programs the search for proposals takes too long

function fail(memory: boolean, words: string): void {
  end();
  refusal.value = { kind: memory ? 'memory' : 'failed', words };
}

const isMachine = (name: string): boolean => /\.toml$/i.test(name);
const isTools = (name: string): boolean => /\.tbl$/i.test(name);
const mostMachineBytes = 1 << 20;

async function machineOf(file: File): Promise<ChosenMachine> {
  if (!isMachine(file.name)) return importMachine(file, await loadModule(), newWorker);
  if (file.size > mostMachineBytes) throw new Error(file.name);
  return { file: file.name, text: await file.text(), own: true };
}

// Takes dropped files: a machine, a tool table and the program. The files after the program are its subroutines.
export async function take(files: readonly File[]): Promise<void> {
  const rest: File[] = [];
  for (const file of files) {
    const isOne = isMachine(file.name) || isConfiguration(file.name) || (!isTools(file.name) && (await isSettingsDump(file)));
    if (!isOne) {
      rest.push(file);
      continue;
    }
    try {
      chosenMachine.value = await machineOf(file);
    } catch (error) {
      forget();
      refusal.value = { kind: 'other-file', words: error instanceof Error ? error.message : file.name };
      return;
    }
  }
  const first = rest.find((one) => !isTools(one.name));
  if (rest.length > 0) otherFiles.value = rest.filter((one) => one !== first);
  if (first !== undefined) choose(first);
  else if (program.peek() !== null) void check();
}

function choose(file: File): void {
  text.peek()?.end();
  program.value = file;
  text.value = file.size <= mostBytes ? new FileText(file) : null;
  void check();
}
