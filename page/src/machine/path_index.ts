// What the daemon knows of the shown program's path: how many chunks, and its boxes.
import { computed, signal } from '@preact/signals';
import { placeText } from '../core/units';
import type { Place } from './api';

export interface Box {
  low: [number, number, number];
  high: [number, number, number];
}
// How far each axis moves, rapids and G53, G28 and G30 included.
interface Limits {
  low: Place;
  high: Place;
}
export interface Reach {
  machine: Limits;
  work: Limits;
}
// `tool` 0: the program has put none in. `diameter`: mm, by the tool table. `zero_z`: machine Z of the work's zero with
// this tool's length.
export interface UsedTool {
  tool: number;
  diameter: number | null;
  zero_z: number;
  feeds: boolean; // else it makes rapids alone
}
export interface PathIndex {
  program: number;
  checks: number; // which check of the program finds it
  growing: boolean; // the check goes on
  complete: boolean;
  cut_off: boolean;
  points: number;
  chunks: number;
  levels: number;
  all: Box | null; // machine coordinates
  cuts: Box | null;
  work: Box | null; // feeds, work coordinates
  reach: Reach | null; // null: nothing moves
  speeds: { low: number; high: number } | null; // programmed feeds, mm/min
  tools: UsedTool[];
}
export const pathIndex = signal<PathIndex | null>(null);
// Of the whole program: nothing is told of a box that grows.
export const pathBox = computed<Box | null>(() => (pathIndex.value?.complete === true ? pathIndex.value.work : null));
// For a table: an axis, and where it moves in the work's coordinates and in the machine's.
export function rowsOfReach({ work, machine }: Reach): string[][] {
  const range = (limits: Limits, axis: string): string => `${placeText(axis, limits.low[axis] ?? 0)} … ${placeText(axis, limits.high[axis] ?? 0)}`;
  return Object.keys(machine.low).map((axis) => [axis.toUpperCase(), range(work, axis), range(machine, axis)]);
}
// How much of the path has come: 0 to 1.
export const pathLoaded = signal(1);
