// Dangerous actions ask once, with facts.
import { signal } from '@preact/signals';
import type { Report } from './faults';

export interface Question {
  title: string;
  facts: string[];
  columns?: string[]; // the names above the rows; the first column has none
  rows?: string[][]; // a name, and its values
  steps?: Report[]; // what happens, in this order
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
