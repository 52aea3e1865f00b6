// What the server reports, in the language of the page: by its stable code and its arguments. Where it sends none (a finding
// in a program, or the history of an older version), by its English words.
import { faults as en } from '../lang/en/faults';
import { faults as fr } from '../lang/fr/faults';
import { faults as it } from '../lang/it/faults';
import { faults as zh } from '../lang/zh/faults';
import { findingIn, shownAs } from './findings';
import { fill, language, say, type Key } from './language';

export interface Sentence {
  code: string; // empty: none
  arguments: Record<string, string>;
}
// With the English words: a client that does not know the code shows these.
export interface Report {
  words: string;
  sentence: Sentence | null;
}

export const faults = { en, fr, it, zh } as const;
const isKnown = (code: string): code is keyof typeof en => code in en;

const shown: typeof shownAs = { ...shownAs, state: (words) => say(`state.${words}` as Key) };

// Null: neither the code nor the words are known in the page's language.
export function reportIn({ words, sentence }: Report): string | null {
  if (words === '' || !sentence || !isKnown(sentence.code)) return findingIn(words);
  const values = Object.entries(sentence.arguments).map(([name, value]) => [name, (shown[name] ?? String)(value)] as const);
  return fill(faults[language.value][sentence.code], Object.fromEntries(values));
}
export const reportWords = (words: string, sentence: Sentence | null): string => reportIn({ words, sentence }) ?? words;
