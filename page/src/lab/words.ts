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

export const methodWords = (code: MethodCode): string => say(`method_${code}`);
export const methodLesson = (code: MethodCode): string => say(`lesson_${code}`);
export const ruleWords = (rule: Rule): string => say(`rule_${rule}`);
export const driveWords = (drive: DriveName): string => say(`drive_${drive}`);
