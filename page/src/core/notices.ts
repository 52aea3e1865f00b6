// What the page tells in passing: refusals, and what was done. Screen readers hear it.
import { signal } from '@preact/signals';
import { toldOr } from './told';

export interface Notice {
  id: number;
  kind: 'done' | 'refused';
  words: string;
}
export const notices = signal<Notice[]>([]);
const most = 3;
const shownFor = 7000; // ms
let last = 0;

export function notify(kind: Notice['kind'], words: string): void {
  const notice = { id: ++last, kind, words };
  notices.value = [...notices.peek().filter((one) => one.words !== words), notice].slice(-most);
  setTimeout(() => dismiss(notice.id), shownFor);
}

export function dismiss(id: number): void {
  notices.value = notices.peek().filter((one) => one.id !== id);
}

export const wordsOfError = (error: unknown): string => toldOr(error instanceof Error ? error.message : String(error));

// Does what a button asks, and tells why it was refused.
export async function attempt(what: () => Promise<unknown>): Promise<boolean> {
  try {
    await what();
    return true;
  } catch (error) {
    notify('refused', wordsOfError(error));
    return false;
  }
}
