// Programs made of drawings and pictures: the daemon makes them as `passo cam` does, beside the machine.
import { signal } from '@preact/signals';
import { attempt } from '../core/notices';
import { get, post, remove, upload } from './api';
import { chosen, refreshPrograms } from './programs';

export interface Cam {
  jobs: string[];
  files: string[];
  state: 'none' | 'running' | 'done' | 'failed';
  job: string;
  progress: number; // 0 to 1
  words: string;
  picture: string;
  program: number | null;
  programs: number[]; // in the order in which they are run
  report: BoardReport | null;
  page: boolean; // what to do when, as a file of its own
}
// What `passo cam board --json` tells.
export type BoardStepKind =
  | 'blank'
  | 'drill'
  | 'heights-front'
  | 'heights-back'
  | 'front'
  | 'mask-front'
  | 'turn'
  | 'find-holes'
  | 'back'
  | 'mask-back'
  | 'edge'
  | 'stencil-front'
  | 'stencil-back';
export interface BoardStep {
  step: BoardStepKind;
  title: string;
  program: string; // its file; empty: there is none
  tools: string[];
  figures: string;
  time_s: number | null;
}
export interface BoardFile {
  file: string;
  name: string; // within its folder or archive
  layer: string; // "top copper"
  told_by: 'attribute' | 'name' | 'content' | 'you';
  drill_file: boolean;
}
export interface BoardReport {
  machine: string;
  files: BoardFile[];
  left_out: string[];
  board: { across_mm: number; up_mm: number };
  copies?: { count: number; across_mm: number; up_mm: number }; // of the board on one blank
  registration?: { holes: { x_mm: number; y_mm: number }[]; axis_mm: number }; // the holes about which the board is flipped
  margin_mm: number;
  up: 'front' | 'back';
  turn: '' | 'x' | 'y';
  holes: '' | 'pins' | 'probe';
  steps: BoardStep[];
}
// What GET /cam/operations says of an operation: JSON Schema, and more.
export interface CamOption {
  'x-kind': string;
  'x-for'?: 'experts' | 'programs';
  'x-of-job'?: boolean;
  'x-of-machine'?: boolean;
  'x-names'?: string; // of a file: what else a value may name
  enum?: string[];
  examples?: string[];
  default?: string | number;
  type: string | string[];
}
export interface CamOperation {
  title: string; // "drill"
  'x-accepts': string; // ".svg,.dxf"
  'x-most-files'?: number;
  'x-instead-of-files'?: string;
  'x-parts'?: string[];
  properties: Record<string, CamOption>;
}
export const operations = signal<readonly CamOperation[]>([]);
// A kind of operation of a job file.
export interface PartKind {
  kind: string;
  command: string; // the operation whose options it has
  options: string[];
  first_tool: string; // the key of its second tool; empty: it has one tool
  file: string; // the key of what it cuts
  has_place: boolean;
}
export const partKinds = signal<readonly PartKind[]>([]);

// A key of a tool of a job file.
export interface ToolKey {
  key: string; // "diameter_mm"
  kind: 'text' | 'choice' | 'flag' | 'number' | 'integer';
  shapes: string[]; // that have it; none: all
  choices?: string[]; // the first one is the default, unless one is needed
  range?: [number, number];
  needed: boolean;
}
export const toolKeys = signal<readonly ToolKey[]>([]);

// They do not change while the daemon runs.
export async function needOperations(): Promise<void> {
  if (operations.value.length > 0) return;
  await attempt(async () => {
    const all = await get<{ operations: CamOperation[]; part_kinds: PartKind[]; tool_keys: ToolKey[] }>('/cam/operations');
    operations.value = all.operations;
    partKinds.value = all.part_kinds;
    toolKeys.value = all.tool_keys;
  });
}

export const cam = signal<Cam | null>(null);
// Counts the orders that have ended, so that each has a picture of its own.
export const madeCount = signal(0);

const lookEvery = 150; // ms
const settle = 500; // ms after the last change of a form

export async function refreshCam(): Promise<void> {
  await attempt(async () => (cam.value = await get<Cam>('/cam')));
}

export async function sendDrawing(file: File): Promise<void> {
  await attempt(async () => (cam.value = await upload<Cam>('/cam/files', file.name, file)));
}

export async function removeDrawing(name: string): Promise<boolean> {
  return attempt(async () => {
    cam.value = (await remove(`/cam/files?name=${encodeURIComponent(name)}`)) as Cam;
  });
}

export async function clearDrawings(): Promise<void> {
  await attempt(async () => {
    cam.value = (await remove('/cam/files')) as Cam;
  });
}

export interface Order {
  job: string;
  files: string[];
  options: Options;
  profile?: Record<string, Options>; // of a board: options of the jobs that it needs
}
export type Options = Record<string, string | number | boolean | string[]>;

let wanted: Order | null = null;
let works = false;
let timer: ReturnType<typeof setTimeout> | undefined;

// Makes it soon; a later order before its turn takes its place.
export function order(next: Order): void {
  wanted = next;
  clearTimeout(timer);
  timer = setTimeout(() => void work(), settle);
}

async function work(): Promise<void> {
  if (works) return;
  works = true;
  while (wanted !== null) {
    const now = wanted;
    wanted = null;
    await attempt(async () => {
      cam.value = await post<Cam>('/cam', now);
      while (cam.value?.state === 'running') {
        await new Promise((resolve) => setTimeout(resolve, lookEvery));
        cam.value = await get<Cam>('/cam');
      }
      ++madeCount.value;
      if (cam.value?.program != null) {
        chosen.value = cam.value.program;
        await refreshPrograms();
      }
    });
  }
  works = false;
}
