// Dangerous actions ask once, with facts.
import { signal } from '@preact/signals';

export interface Question {
  title: string;
  facts: string[];
  columns?: string[]; // the names above the rows; the first column has none
  rows?: string[][]; // a name, and its values
  steps?: string[]; // what happens, in this order; the daemon's words
  yes: string;
  kind: 'go' | 'stop' | 'plain';
}
interface Asked extends Question {
  answer: (yes: boolean) => void;
}
export const asked = signal<Asked | null>(null);

export function confirm(question: Question): Promise<boolean> {
  asked.value?.answer(false);
  return new Promise((resolve) => {
    asked.value = {
      ...question,
      answer: (yes) => {
        asked.value = null;
        resolve(yes);
      },
    };
  });
}
