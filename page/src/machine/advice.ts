// What a person does next with a job that was broken off: the banner and the card say the same.
import { computed } from '@preact/signals';
import { say, type Key } from '../core/language';
import { canHome } from './abilities';
import { status } from './connection';
import { interrupted, type Interrupted } from './interrupted';

export type Advice = 'resume' | 'home' | 'place' | 'reenter' | 'drop';

export function adviceFor(broken: Interrupted, trust: string, homes: boolean): Advice {
  if (broken.goes_on) return 'resume';
  if (homes && trust !== 'homed') return 'home';
  if (trust === 'unknown') return 'place';
  return broken.reentry.code === '' ? 'reenter' : 'drop';
}

export const advice = computed<Advice | null>(() => {
  const broken = interrupted.value;
  return broken === null ? null : adviceFor(broken, status.value?.trust ?? 'unknown', canHome.value);
});
export const adviceWords = computed(() => {
  const now = advice.value;
  return now === null ? '' : say(`broken.next.${now}` as Key, { name: interrupted.value?.job.name ?? '' });
});
