// Where the tool is: in the machine's coordinates, and in those of the work.
import { computed } from '@preact/signals';
import { lengthUnit, placeText } from '../core/units';
import type { Place } from './api';
import { machine, status } from './connection';

export const axes = computed<string[]>(() => machine.value?.axes.map((one) => one.axis) ?? Object.keys(status.value?.place ?? {}));
export const machinePlace = computed<Place>(() => status.value?.place ?? {});
export const workOffset = computed<Place>(() => status.value?.work_offset ?? {});
export const workPlace = computed<Place>(() => inWork(machinePlace.value, workOffset.value));

export function inWork(place: Place, offset: Place): Place {
  return Object.fromEntries(Object.entries(place).map(([axis, value]) => [axis, value - (offset[axis] ?? 0)]));
}

export function placeWords(place: Place): string {
  const parts = Object.entries(place).map(([axis, value]) => `${axis.toUpperCase()} ${placeText(axis, value)}`);
  return `${parts.join('  ')} ${lengthUnit()}`;
}
