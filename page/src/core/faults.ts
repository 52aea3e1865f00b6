// What the server reports, in the language of the page: refusals and faults, and what is found in programs and machine files.
// A sentence has a stable code and arguments.
import { faults as enFaults } from '../lang/en/faults';
import { findings as enFindings } from '../lang/en/findings';
import { faults as frFaults } from '../lang/fr/faults';
import { findings as frFindings } from '../lang/fr/findings';
import { faults as itFaults } from '../lang/it/faults';
import { findings as itFindings } from '../lang/it/findings';
import { faults as zhFaults } from '../lang/zh/faults';
import { findings as zhFindings } from '../lang/zh/findings';
import { fill, language, say, type Key } from './language';
import { placeText, speedText, speedUnit } from './units';

export interface Sentence {
  code: string; // empty: none
  arguments: Record<string, string>;
}
// With the English words: a client that does not know the code shows these.
export interface Report {
  words: string;
  sentence: Sentence | null;
}

export const faults = { en: enFaults, fr: frFaults, it: itFaults, zh: zhFaults } as const;
export const findings = { en: enFindings, fr: frFindings, it: itFindings, zh: zhFindings } as const;
const reports = {
  en: { ...enFaults, ...enFindings },
  fr: { ...frFaults, ...frFindings },
  it: { ...itFaults, ...itFindings },
  zh: { ...zhFaults, ...zhFindings },
} as const;
const isKnown = (code: string): code is keyof typeof reports.en => code in reports.en;

const shownHeight = (words: string): string => placeText('z', Number(words));
const shownPlace = (words: string): string => words.replace(/([A-Z])(-?[\d.]+)/g, (_, axis: string, at: string) => axis + placeText(axis.toLowerCase(), Number(at)));
function shownSpeed(words: string): string {
  const found = /^([\d.]+) mm\/min$/.exec(words);
  return found === null ? words : `${speedText(Number(found[1]))} ${speedUnit()}`;
}
// A program aborts with a text of its own. That of a probing cycle is known by its words.
const boresApart = /the bores are (.+) mm apart; they should be (.+) mm apart$/;
const shownAbort = (words: string): string =>
  words.replace(boresApart, (_, apart: string, way: string) => fill(reports[language.value]['probing.bores-apart'], { apart, way }));
// The sentence that another one holds: its text is the argument NAME, and its code and arguments stand beside it.
function heldIn(name: string, all: Record<string, string>): Sentence | null {
  const code = all[`${name}.code`];
  const head = `${name}.arguments.`;
  const own = Object.entries(all).filter(([key]) => key.startsWith(head));
  return code === undefined ? null : { code, arguments: Object.fromEntries(own.map(([key, value]) => [key.slice(head.length), value])) };
}

// How an argument of that name is shown.
const shown: Record<string, (value: string, all: Record<string, string>) => string> = {
  finding: (words, all) => reportWords(words, heldIn('finding', all)),
  why: (words, all) => reportWords(words, heldIn('why', all)),
  words: shownAbort,
  state: (words) => say(`state.${words}` as Key),
  z: shownHeight,
  cut: shownHeight,
  deepest: shownHeight,
  place: shownPlace,
  feed: shownSpeed,
};

// Null: the code is not known here, or there is none.
export function reportIn({ words, sentence }: Report): string | null {
  if (words === '') return '';
  if (!sentence || !isKnown(sentence.code)) return null;
  const all = sentence.arguments;
  const values = Object.entries(all).map(([name, value]) => [name, (shown[name] ?? String)(value, all)] as const);
  return fill(reports[language.value][sentence.code], Object.fromEntries(values));
}
export const reportWords = (words: string, sentence: Sentence | null): string => reportIn({ words, sentence }) ?? words;
