// The lab's words, in the four languages of the page. They load with the lab, and not before.
import { fill, language, type Language } from '../core/language';
import { en as boardEn } from './board/lang/en';
import { fr as boardFr } from './board/lang/fr';
import { it as boardIt } from './board/lang/it';
import { zh as boardZh } from './board/lang/zh';
import type { DriveName, Rule } from './core';
import { en as driverEn } from './driver/lang/en';
import { fr as driverFr } from './driver/lang/fr';
import { it as driverIt } from './driver/lang/it';
import { zh as driverZh } from './driver/lang/zh';
import { en } from './lang/en';
import { fr } from './lang/fr';
import { it } from './lang/it';
import { zh } from './lang/zh';
import type { MethodCode } from './view';

const english = { ...en, ...boardEn, ...driverEn };
export type LabKey = keyof typeof english;
export const labTables: Record<Language, Record<LabKey, string>> = {
  en: english,
  it: { ...it, ...boardIt, ...driverIt },
  fr: { ...fr, ...boardFr, ...driverFr },
  zh: { ...zh, ...boardZh, ...driverZh },
};

export function say(key: LabKey, values: Record<string, string | number> = {}): string {
  return fill(labTables[language.value][key], values);
}

// The program gives its reasons in English. The usual ones have words in each language; of another reason, the other
// languages say only that the values do not fit.
const reasons: readonly (readonly [string, LabKey])[] = [
  ['divides by zero if an axis does not move', 'reasonAxisStill'],
  ["the supply must be above the transistor's drop", 'reasonDrop'],
  ['the supply voltage minus the drop must be above 0', 'reasonDrop'],
  ["the logic's voltage must be above the base's", 'reasonLogic'],
  ["more than a table method's 16 bits hold", 'reasonTable'],
  ['above the start rate of', 'reasonStart'],
  ['the loop does not oscillate at any gain', 'reasonNoSwing'],
];
export function refusal(reason: string): string {
  if (language.value === 'en') return reason;
  const known = reasons.find(([part]) => reason.includes(part));
  return say(known ? known[1] : 'refused');
}

// The columns of the program's tables: "sum_x" is the sum of X.
const columns = [
  'ideal', 'midline', 'sum', 'slope_left', 'slope', 'block', 'run', 'judge', 'at_midpoint', 'reached', 'middle',
  'decision', 'accumulator', 'excess', 'plain', 'blocks', 'deviation', 'left',
] as const;
export function columnWords(name: string): string {
  const column = columns.find((one) => name === one || (name.startsWith(`${one}_`) && name.length === one.length + 2));
  if (!column) return name;
  const words = say(`column_${column}`);
  return name === column ? words : `${words} ${name.slice(-1).toUpperCase()}`;
}
export const cellText = (cell: string): string => cell.replace(' of ', '/').replace('>=', ' ≥ ').replace('<', ' < ').replaceAll('-', '−');

export const methodWords = (code: MethodCode): string => say(`method_${code}`);
export const methodLesson = (code: MethodCode): string => say(`lesson_${code}`);
export const ruleWords = (rule: Rule): string => say(`rule_${rule}`);
export const driveWords = (drive: DriveName): string => say(`drive_${drive}`);
