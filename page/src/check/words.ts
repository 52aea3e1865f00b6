// The words of "Check my program", in the four languages of the page.
import { fill, language, type Language } from '../core/language';
import { en } from './lang/en';
import { fr } from './lang/fr';
import { it } from './lang/it';
import { zh } from './lang/zh';

export type CheckKey = keyof typeof en;
export const checkTables: Record<Language, Record<CheckKey, string>> = { en, it, fr, zh };

export function say(key: CheckKey, values: Record<string, string | number> = {}): string {
  return fill(checkTables[language.value][key], values);
}
