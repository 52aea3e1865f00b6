// The lab's words, in the four languages of the page. They load with the lab, and not before.
import { fill, language, type Language } from '../core/language';
import type { DriveName, Rule } from './core';
import { en, type LabWords } from './lang/en';
import { fr } from './lang/fr';
import { it } from './lang/it';
import { zh } from './lang/zh';
import type { MethodCode } from './view';

export const labTables: Record<Language, LabWords> = { en, it, fr, zh };
export type LabKey = keyof LabWords;

export function say(key: LabKey, values: Record<string, string | number> = {}): string {
  return fill(labTables[language.value][key], values);
}

export const methodWords = (code: MethodCode): string => say(`method_${code}`);
export const methodLesson = (code: MethodCode): string => say(`lesson_${code}`);
export const ruleWords = (rule: Rule): string => say(`rule_${rule}`);
export const driveWords = (drive: DriveName): string => say(`drive_${drive}`);
