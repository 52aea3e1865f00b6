// Where the tool is: in the machine's coordinates, and in those of the work.
import { stable } from '../core/stable';
import { lengthUnit, placeText } from '../core/units';
import type { Place } from './api';
import { machine, status } from './connection';

export const axes = stable<string[]>(() => machine.value?.axes.map((one) => one.axis) ?? Object.keys(status.value?.place ?? {}));
export const machinePlace = stable<Place>(() => status.value?.place ?? {});
export const workOffset = stable<Place>(() => status.value?.work_offset ?? {});
export const workRotation = stable<number>(() => status.value?.work_rotation ?? 0); // degrees about Z
// A program has zeros of its own: other work coordinate systems, and the offsets of its tools.
const zeroNow = stable<Place>(() => status.value?.program_zero ?? workOffset.value);
export const workPlace = stable<Place>(() => inWork(machinePlace.value, zeroNow.value, workRotation.value));

// The work's X and Y may be turned about Z: machine = offset + turned(work).
export function inWork(place: Place, offset: Place, degrees: number): Place {
  const work = Object.fromEntries(Object.entries(place).map(([axis, value]) => [axis, value - (offset[axis] ?? 0)]));
  if (degrees === 0 || work.x === undefined || work.y === undefined) return work;
  const [x, y] = turned(work.x, work.y, -degrees);
  return { ...work, x, y };
}

export function turned(x: number, y: number, degrees: number): [number, number] {
  const angle = (degrees * Math.PI) / 180;
  return [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle)];
}

export function placeWords(place: Place): string {
  const parts = Object.entries(place).map(([axis, value]) => `${axis.toUpperCase()} ${placeText(axis, value)}`);
  return `${parts.join('  ')} ${lengthUnit()}`;
}
