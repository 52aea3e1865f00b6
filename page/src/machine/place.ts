// Where the tool is: in the machine's coordinates, and in those of the work.
import { stable } from '../core/stable';
import { lengthUnit, placeText } from '../core/units';
import type { Place } from './api';
import { machine, status } from './connection';

export const axes = stable<string[]>(() => machine.value?.axes.map((one) => one.axis) ?? Object.keys(status.value?.place ?? {}));
export const machinePlace = stable<Place>(() => status.value?.place ?? {});
export const workOffset = stable<Place>(() => status.value?.work_offset ?? {});
export const workPlace = stable<Place>(() => inWork(machinePlace.value, workOffset.value));

export function inWork(place: Place, offset: Place): Place {
  return Object.fromEntries(Object.entries(place).map(([axis, value]) => [axis, value - (offset[axis] ?? 0)]));
}

export function placeWords(place: Place): string {
  const parts = Object.entries(place).map(([axis, value]) => `${axis.toUpperCase()} ${placeText(axis, value)}`);
  return `${parts.join('  ')} ${lengthUnit()}`;
}
