// What the daemon says, in the language of the page. The daemon speaks English; a sentence is known by its pieces.
import { file } from '../lang/told/file';
import { foreign } from '../lang/told/foreign';
import { machine } from '../lang/told/machine';
import { program } from '../lang/told/program';
import type { Saying } from '../lang/told/saying';
import { fill, language, say, type Key } from './language';
import { placeText, speedText, speedUnit, units } from './units';

export const sayings: readonly Saying[] = [...machine, ...program, ...file, ...foreign];

interface Pattern {
  saying: Saying;
  names: string[];
  words: RegExp;
}
const literal = (piece: string): string => piece.replace(/[.*+?^$()[\]\\]/g, '\\$&').replace(/’/g, "['’]");
const pieces = (words: string): string[] => words.split(/\{\w+\}/);
const bars = /\|/g;
const fixedLength = (words: string): number => pieces(words).join('').length;
function patternOf(saying: Saying): Pattern {
  const names = [...saying.en.matchAll(/\{(\w+)\}/g)].map((one) => one[1] ?? '');
  return { saying, names, words: new RegExp(`^${pieces(saying.en.replace(bars, '')).map(literal).join('(.+?)')}$`) };
}
const wraps = (saying: Saying): number => (saying.en.includes('{saying}') ? 1 : 0);
// What stands around another sentence first, then the most telling: "{key} is {value}" fits many.
let patterns: Pattern[] | undefined;
const allPatterns = (): Pattern[] =>
  (patterns ??= [...sayings].sort((a, b) => wraps(b) - wraps(a) || fixedLength(b.en) - fixedLength(a.en)).map(patternOf));

const shownPlace = (words: string): string => words.replace(/([A-Z])(-?[\d.]+)/g, (_, axis: string, at: string) => axis + placeText(axis.toLowerCase(), Number(at)));
function shownSpeed(words: string): string {
  const found = /^([\d.]+) mm\/min$/.exec(words);
  return found === null ? words : `${speedText(Number(found[1]))} ${speedUnit()}`;
}
const values: Record<string, (words: string) => string> = {
  saying: (words) => words.replace(/\S.*/s, toldOr),
  state: (words) => say(`state.${words}` as Key),
  z: (words) => placeText('z', Number(words)),
  place: shownPlace,
  feed: shownSpeed,
};

// Null: this sentence is not known in the page's language.
export function told(words: string): string | null {
  const to = language.value;
  if (words === '' || (to === 'en' && units.value === 'mm')) return words;
  for (const { saying, names, words: pattern } of allPatterns()) {
    const found = pattern.exec(words);
    if (found === null) continue;
    const shown = names.map((name, i) => [name, (values[name] ?? String)(found[i + 1] ?? '')] as const);
    return fill(saying[to].replace(bars, ''), Object.fromEntries(shown));
  }
  return to === 'en' ? words : null;
}
export const toldOr = (words: string): string => told(words) ?? words;
