// A job that was broken off, and how it goes on: with `passo serve --data` and a board alone.
import { computed, effect, signal } from '@preact/signals';
import type { Report, Sentence } from '../core/faults';
import { get, type HistoryJob, type Place } from './api';
import { isLive, status } from './connection';
import { isUnderWay } from './words';

// What happens before a program goes on amid its path, step by step, in the machine's coordinates. With a `code` there is
// no such way, and `why` tells the reason.
export interface Way {
  line: number | null;
  place: Place | null;
  steps: string[];
  step_sentences: Sentence[];
  code: string;
  why: string;
  why_sentence: Sentence;
}
export const stepsOf = (way: Way): Report[] => way.steps.map((words, i) => ({ words, sentence: way.step_sentences[i] ?? null }));

export interface Interrupted {
  job: HistoryJob;
  noted_at: number;
  line: number | null;
  place: Place | null;
  steps: Record<string, number>;
  goes_on: boolean;
  code: string;
  why: string;
  why_sentence: Sentence;
  reentry: Way;
}

export const interrupted = signal<Interrupted | null>(null);

export async function refreshInterrupted(): Promise<void> {
  try {
    interrupted.value = (await get<{ interrupted: Interrupted | null }>('/interrupted')).interrupted;
  } catch {
    interrupted.value = null; // nothing is kept, or the connection is lost: both are told elsewhere
  }
}

// Homing, a jog and a job change whether and how it goes on.
const affects = computed(() => {
  const now = status.value;
  if (!isLive.value || isUnderWay(now?.job ?? null)) return '';
  return `${now?.state} ${now?.trust} ${now?.job?.id} ${now?.job?.state}`;
});

export function followInterrupted(): void {
  effect(() => {
    if (affects.value !== '') void refreshInterrupted();
    else interrupted.value = null;
  });
}
