// What the daemon knows of the shown program's path: its chunks and its box, in work coordinates.
import { computed, signal } from '@preact/signals';

export interface PathIndex {
  program: number;
  complete: boolean;
  chunks: number;
  points: number;
  low: [number, number, number];
  high: [number, number, number];
}
export const pathIndex = signal<PathIndex | null>(null);
export const pathBox = computed(() => (pathIndex.value !== null && pathIndex.value.points > 0 ? pathIndex.value : null));
