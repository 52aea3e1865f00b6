// What the page tells in passing: refusals, and what was done. Screen readers hear it.
import { signal } from '@preact/signals';
import { reportWords, type Sentence } from './faults';

export interface Notice {
  id: number;
  kind: 'done' | 'refused';
  words: string;
  hint: string; // what would have been right, for the log
}
export const notices = signal<Notice[]>([]);
const most = 3;
const shownFor = 7000; // ms
let last = 0;

export function notify(kind: Notice['kind'], words: string, hint = ''): void {
  const notice = { id: ++last, kind, words, hint };
  notices.value = [...notices.peek().filter((one) => one.words !== words), notice].slice(-most);
  setTimeout(() => dismiss(notice.id), shownFor);
}

export function dismiss(id: number): void {
  notices.value = notices.peek().filter((one) => one.id !== id);
}

type Sentences = { sentence?: Sentence | null; expectedSentence?: Sentence | null };
const sentencesOf = (error: Error): Sentences => error as object;
export const wordsOfError = (error: unknown): string => (error instanceof Error ? reportWords(error.message, sentencesOf(error).sentence ?? null) : String(error));
const hintOfError = (error: unknown): string =>
  error instanceof Error && 'expected' in error && typeof error.expected === 'string' ? reportWords(error.expected, sentencesOf(error).expectedSentence ?? null) : '';

// Does what a button asks, and tells why it was refused.
export async function attempt(what: () => Promise<unknown>): Promise<boolean> {
  try {
    await what();
    return true;
  } catch (error) {
    notify('refused', wordsOfError(error), hintOfError(error));
    return false;
  }
}
