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

// The program gives its reasons in English; in another language only that the values do not fit.
export const refusal = (reason: string): string => (language.value === 'en' ? reason : say('refused'));

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
