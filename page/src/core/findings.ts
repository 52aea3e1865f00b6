// What is found in programs and machine files, in the language of the page. A finding is recognised by its English sentence.
import { findings as en } from '../lang/en/findings';
import { findings as fr } from '../lang/fr/findings';
import { findings as it } from '../lang/it/findings';
import { findings as zh } from '../lang/zh/findings';
import { fill, language } from './language';
import { placeText, speedText, speedUnit, units } from './units';

export type FindingKey = keyof typeof en;
export const findings = { en, fr, it, zh } as const;

interface Pattern {
  key: FindingKey;
  names: string[];
  words: RegExp;
}
const literal = (piece: string): string => piece.replace(/[.*+?^$()[\]\\]/g, '\\$&').replace(/’/g, "['’]");
const pieces = (words: string): string[] => words.split(/\{\w+\}/);
const bars = /\|/g;
const fixedLength = (words: string): number => pieces(words).join('').length;
function patternOf(key: FindingKey): Pattern {
  const names = [...en[key].matchAll(/\{(\w+)\}/g)].map((one) => one[1] ?? '');
  return { key, names, words: new RegExp(`^${pieces(en[key].replace(bars, '')).map(literal).join('(.+?)')}$`) };
}
const wraps = (key: FindingKey): number => (en[key].includes('{finding}') ? 1 : 0);
// What stands around another sentence first, then the longest: "{key} is {value}" fits many.
let patterns: Pattern[] | undefined;
const allPatterns = (): Pattern[] =>
  (patterns ??= (Object.keys(en) as FindingKey[]).sort((a, b) => wraps(b) - wraps(a) || fixedLength(en[b]) - fixedLength(en[a])).map(patternOf));

const shownPlace = (words: string): string => words.replace(/([A-Z])(-?[\d.]+)/g, (_, axis: string, at: string) => axis + placeText(axis.toLowerCase(), Number(at)));
function shownSpeed(words: string): string {
  const found = /^([\d.]+) mm\/min$/.exec(words);
  return found === null ? words : `${speedText(Number(found[1]))} ${speedUnit()}`;
}
// How an argument of that name is shown.
export const shownAs: Record<string, (words: string) => string> = {
  finding: (words) => words.replace(/\S.*/s, findingWords),
  z: (words) => placeText('z', Number(words)),
  place: shownPlace,
  feed: shownSpeed,
};

// Null: this sentence is not known in the page's language.
export function findingIn(words: string): string | null {
  const to = language.value;
  if (words === '' || (to === 'en' && units.value === 'mm')) return words;
  for (const { key, names, words: pattern } of allPatterns()) {
    const found = pattern.exec(words);
    if (found === null) continue;
    const shown = names.map((name, i) => [name, (shownAs[name] ?? String)(found[i + 1] ?? '')] as const);
    return fill(findings[to][key].replace(bars, ''), Object.fromEntries(shown));
  }
  return to === 'en' ? words : null;
}
export const findingWords = (words: string): string => findingIn(words) ?? words;
