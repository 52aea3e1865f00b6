import { describe, expect, it } from 'vitest';
import { fill, languageOf } from '../src/core/language';
import { en } from '../src/lang/en';
import { fr } from '../src/lang/fr';
import { it as italian } from '../src/lang/it';
import { zh } from '../src/lang/zh';

const names = (words: string): string[] => (words.match(/\{\w+\}/g) ?? []).sort();

describe('languages', () => {
  it('has the same places for values in each translation', () => {
    for (const table of [italian, fr, zh]) {
      for (const key of Object.keys(en) as (keyof typeof en)[]) {
        expect(names(table[key]), key).toEqual(names(en[key]));
        expect(table[key].trim(), key).not.toBe('');
      }
    }
  });

  it('fills in values, and leaves what it does not know', () => {
    expect(fill('Line {line} of {lines}', { line: 3 })).toBe('Line 3 of {lines}');
  });

  it('finds a language among those that a browser prefers', () => {
    expect(languageOf(['de-CH', 'fr-CH', 'en'])).toBe('fr');
    expect(languageOf(['zh-TW'])).toBe('zh');
    expect(languageOf(['de'])).toBe('en');
  });
});
