// The files that the board stores: as last listed, and how the last order goes. The server sends a file to the board, and
// tells how far it is.
import { computed, signal } from '@preact/signals';
import type { Sentence } from '../core/faults';
import { attempt } from '../core/notices';
import { ask, get, post } from './api';
import { machine } from './connection';
import { beOwner } from './owner';
import { refreshPrograms } from './programs';

export interface BoardFile {
  path: string; // "/sd/part.nc"
  bytes: number;
  can_run: boolean;
  program: number | null; // with its text; null: nothing is known of what it does
}
export interface BoardFilesTold {
  has_storage: boolean;
  folder: string; // of the card: "/", "/sd/"
  why_no_upload: Sentence | null;
  words_no_upload: string;
  state: 'none' | 'running' | 'done' | 'failed';
  order: 'list' | 'upload' | 'remove' | null;
  path: string;
  why: Sentence | null;
  words: string;
  share: number;
  left: number | null; // s
  files: BoardFile[] | null; // null: not listed yet
}

const lookEvery = 200; // ms
const longestUpload = 600_000; // ms, until the server has the file

export const toldFiles = signal<BoardFilesTold | null>(null);
export const hasStorage = computed(() => machine.value?.abilities.some((one) => one.ability === 'board-files' && one.can) ?? false);
export const worksAtFiles = computed(() => toldFiles.value?.state === 'running');

let following = false;
export async function learnFiles(): Promise<void> {
  if (following) return;
  following = true;
  try {
    await attempt(async () => {
      do {
        toldFiles.value = await get<BoardFilesTold>('/board/files');
        if (worksAtFiles.value) await new Promise((resolve) => setTimeout(resolve, lookEvery));
      } while (worksAtFiles.value);
    });
  } finally {
    following = false;
  }
}

// Each part between slashes, as the server decodes it.
export const addressOf = (path: string): string => `/board/files/${path.replace(/^\//, '').split('/').map(encodeURIComponent).join('/')}`;
// Where a file of this computer goes.
export const pathFor = (folder: string, name: string): string => folder + name;
export const kiloBytes = (bytes: number): string => (bytes / 1000).toFixed(bytes < 100_000 ? 1 : 0);
// What is known to be there.
export const isThere = (told: BoardFilesTold | null, path: string): boolean => (told?.files ?? []).some((one) => one.path === path);

async function order(begin: () => Promise<unknown>): Promise<void> {
  await attempt(async () => {
    await beOwner();
    await begin();
  });
  await learnFiles();
}

export const listFiles = (): Promise<void> => order(() => post('/board/files'));
export const deleteFile = (path: string): Promise<void> => order(() => ask('DELETE', addressOf(path)));
export async function sendFile(path: string, content: BodyInit): Promise<void> {
  await order(() => ask('PUT', addressOf(path), content, longestUpload, 'application/octet-stream'));
  await refreshPrograms();
}
export const cancelSending = (): Promise<boolean> => attempt(() => post('/stop'));
