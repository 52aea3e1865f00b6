// What the page and its worker say to each other.
import type { Stage } from './host';
import type { SourceNode } from './source_tree';

export interface CheckRequest {
  program: string; // the name of a file
  machine: { name: string; text: string; motor: Record<string, number | boolean> | null };
  dialect: 'linuxcnc' | 'grbl';
  inches: boolean;
  block_delete: boolean;
  tools: string; // the name of a tool table; empty: none
  proposals: boolean;
}
export type ImportName = 'settings' | 'fluidnc' | 'linuxcnc' | 'mach3';
export interface ImportRequest {
  file: string;
  text: string;
  format: ImportName | '';
  tree?: SourceNode;
}
export type ToWorker =
  | { kind: 'import'; module: ArrayBuffer; request: ImportRequest }
  | { kind: 'check'; module: ArrayBuffer; files: readonly File[]; request: CheckRequest }
  | { kind: 'path'; id: number; first: number; count: number; level: number };
export type FromWorker =
  | { kind: 'imported'; answer: string }
  | { kind: 'progress'; stage: Stage; share: number }
  | { kind: 'done'; answer: string; milliseconds: number; bytes: number }
  | { kind: 'path'; id: number; bytes: ArrayBuffer }
  | { kind: 'failed'; memory: boolean; words: string };
