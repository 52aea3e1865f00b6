// The words of the page, in four languages. A key that a language lacks is an error of the compiler.
import { computed, effect } from '@preact/signals';
import { en } from '../lang/en/index';
import { fr } from '../lang/fr/index';
import { it } from '../lang/it/index';
import type { Words } from '../lang/same';
import { zh } from '../lang/zh/index';
import { kept, oneOf } from './kept';

export const languages = { en: 'English', it: 'Italiano', fr: 'Français', zh: '中文' } as const;
export type Language = keyof typeof languages;
export type Key = keyof Words;

const tables: Record<Language, Words> = { en, it, fr, zh };

export function languageOf(wanted: readonly string[]): Language {
  for (const one of wanted) {
    const found = (Object.keys(languages) as Language[]).find((name) => one.toLowerCase().startsWith(name));
    if (found) return found;
  }
  return 'en';
}

export const language = kept<Language>(
  'language',
  languageOf(typeof navigator === 'undefined' ? [] : navigator.languages),
  oneOf('en', 'it', 'fr', 'zh'),
);
const table = computed(() => tables[language.value]);

export function followLanguage(): void {
  effect(() => {
    document.documentElement.lang = language.value;
  });
}

export const isKey = (text: string): text is Key => text in tables.en;

// The words of a key. {name} stands for a value: say('line', {n: 4}).
export function say(key: Key, values: Record<string, string | number> = {}): string {
  return fill(table.value[key], values);
}

// One thing, or several: where a language says both alike, so do its two texts.
type Counted = { [K in Key]: `${K}.one` extends Key ? K : never }[Key];
export function sayCount(key: Counted, count: number, values: Record<string, string | number> = {}): string {
  const isOne = new Intl.PluralRules(language.value).select(count) === 'one';
  return say(isOne ? `${key}.one` : key, { ...values, count: count.toLocaleString(language.value) });
}

// French sets a space before : ; ! ? % » and after «, and no line may break there. The tables have plain spaces.
export const typeset = (words: string, to: Language): string =>
  to === 'fr' ? words.replace(/ (?=[:;!?%»])/g, '\u00a0').replace(/« /g, '«\u00a0') : words;

export function fill(words: string, values: Record<string, string | number>): string {
  return typeset(words, language.value).replace(/\{(\w+)\}/g, (all, name: string) => String(values[name] ?? all));
}
