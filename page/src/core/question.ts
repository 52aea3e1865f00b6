// Dangerous actions ask once, with facts.
import { signal } from '@preact/signals';
import type { Report } from './faults';

// A value that the question asks for. Lengths and speeds are mm and mm/min, whatever is shown.
export interface AskedField {
  name: string;
  title: string;
  measure: 'length' | 'speed' | 'plain';
  unit?: string; // of a plain value
  low: number;
  high: number;
  whole?: boolean;
  value: number | null; // null: empty
  usual?: string; // what an empty field means; without it a value is needed
}
export interface AskedChoice {
  name: string;
  title: string;
  all: (readonly [string, string])[]; // a value and its words; the first is chosen
}
export type Answers = Record<string, number | string>; // without the fields that are empty

export interface Question {
  title: string;
  facts: string[];
  columns?: string[]; // the names above the rows; the first column has none
  rows?: string[][]; // a name, and its values
  steps?: Report[]; // what happens, in this order
  choices?: AskedChoice[];
  fields?: AskedField[];
  yes: string;
  kind: 'go' | 'stop' | 'plain';
}
interface Asked extends Question {
  answer: (yes: boolean) => void;
}
// What is filled in so far.
export const answers = signal<Record<string, number | string | null>>({});
export const asked = signal<Asked | null>(null);

// Why the answer cannot be given yet. Empty: it can.
export function faultOf(field: AskedField): 'missing' | 'range' | '' {
  const value = answers.value[field.name] ?? null;
  if (value === null) return field.usual === undefined ? 'missing' : '';
  const isWrong = typeof value !== 'number' || value < field.low || value > field.high || (field.whole === true && !Number.isInteger(value));
  return isWrong ? 'range' : '';
}

// Asks for values. Null: nobody wants it.
export async function askValues(question: Question): Promise<Answers | null> {
  if (!(await confirm(question))) return null;
  return Object.fromEntries(Object.entries(answers.value).filter((one): one is [string, number | string] => one[1] !== null));
}

export function confirm(question: Question): Promise<boolean> {
  asked.value?.answer(false);
  answers.value = Object.fromEntries([
    ...(question.choices ?? []).map((one) => [one.name, one.all[0]?.[0] ?? null] as const),
    ...(question.fields ?? []).map((one) => [one.name, one.value] as const),
  ]);
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
