// A program that waits for a person (M0, M1, M6), from then until somebody goes on or stops, whatever is done meanwhile.
import { computed } from '@preact/signals';
import { say } from '../core/language';
import { stable } from '../core/stable';
import type { Status, Waits } from './api';
import { status } from './connection';
import { setUpName } from './programs';

// The set-up mode of the outputs waits, too, and has words and buttons of its own.
export const waitsOf = (now: Status | null): Waits | null => (now?.job?.name === setUpName ? null : (now?.waits ?? null));
export const waits = stable<{ now: Waits | null }>(() => ({ now: waitsOf(status.value) }));

// At M0 and M1, where nobody holds the program besides.
export const holdsForPerson = ({ holds }: Status): boolean =>
  holds.includes('program') && !['operator', 'door', 'line-end'].some((reason) => holds.includes(reason));

// Nothing moves, and going on is what comes next.
export const isAtWait = (now: Status): boolean => {
  if (now.state === 'Hold') return holdsForPerson(now);
  return now.state === 'Tool' || (now.state === 'Idle' && waitsOf(now) !== null);
};

// Jog, zero, probe, home, a line of the console.
export const isFree = computed(() => {
  const now = status.value;
  if (now === null) return false;
  const waiting = waitsOf(now);
  return now.state === 'Idle' || (waiting !== null && waiting.free && isAtWait(now));
});

// "M6, line 12, tool 5"
export const wordsOfWait = (one: Pick<Waits, 'for' | 'line' | 'tool'>): string =>
  [one.for, one.line > 0 ? say('wait.line', { line: one.line }) : '', one.tool === null ? '' : say('wait.tool', { tool: one.tool })]
    .filter((words) => words !== '')
    .join(', ');
