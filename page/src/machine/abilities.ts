// What the machine cannot do, and why: shown where it would be used.
import { computed } from '@preact/signals';
import { reportWords } from '../core/faults';
import type { Ability } from './api';
import { machine } from './connection';

// Why the machine cannot do it, as a sentence; empty: it can, or the machine is not known yet.
export function whyUnable(ability: Ability): string {
  const found = machine.value?.abilities.find((one) => one.ability === ability);
  return found === undefined || found.can ? '' : reportWords(found.why, found.sentence);
}

// Whether the machine can be homed at all: it has switches, and its board uses them.
export const canHome = computed(() => (machine.value?.axes.some((one) => one.homes) ?? false) && whyUnable('home') === '');
