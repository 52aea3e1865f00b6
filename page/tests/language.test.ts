import { describe, expect, it } from 'vitest';
import { fill, language, languageOf, sayCount } from '../src/core/language';
import { en } from '../src/lang/en';
import { fr } from '../src/lang/fr';
import { it as italian } from '../src/lang/it';
import { en as camEn } from '../src/lang/cam/en';
import { fr as camFr } from '../src/lang/cam/fr';
import { it as camItalian } from '../src/lang/cam/it';
import { zh as camZh } from '../src/lang/cam/zh';
import { en as moreEn } from '../src/lang/more/en';
import { fr as moreFr } from '../src/lang/more/fr';
import { it as moreItalian } from '../src/lang/more/it';
import { zh as moreZh } from '../src/lang/more/zh';
import { zh } from '../src/lang/zh';

const names = (words: string): string[] => (words.match(/\{\w+\}/g) ?? []).sort();

describe('languages', () => {
  it('has the same places for values in each translation', () => {
    const same = (own: Record<string, string>, tables: readonly Record<string, string>[]): void => {
      for (const table of tables) {
        for (const [key, words] of Object.entries(own)) {
          expect(names(table[key] ?? ''), key).toEqual(names(words));
          expect(table[key]?.trim(), key).not.toBe('');
        }
      }
    };
    same(en, [italian, fr, zh]);
    same(moreEn, [moreItalian, moreFr, moreZh]);
    same(camEn, [camItalian, camFr, camZh]);
  });

  it('says each thing once: no later table hides a word of the first', () => {
    expect(Object.keys(moreEn).filter((key) => key in en)).toEqual([]);
    expect(Object.keys(camEn).filter((key) => key in en || key in moreEn)).toEqual([]);
  });

  it('fills in values, and leaves what it does not know', () => {
    expect(fill('Line {line} of {lines}', { line: 3 })).toBe('Line 3 of {lines}');
  });

  it('counts one thing and several', () => {
    const lines = (count: number): string => sayCount('files.lines', count);
    expect([lines(1), lines(0), lines(2)]).toEqual(['1 line', '0 lines', '2 lines']);
    expect(sayCount('stock.file.read', 1, { name: 'a.toml' })).toBe('a.toml: 1 tool.');
    language.value = 'fr';
    expect([lines(1), lines(2)]).toEqual(['1 ligne', '2 lignes']);
    language.value = 'it';
    expect([lines(1), lines(2)]).toEqual(['1 riga', '2 righe']);
    expect(sayCount('files.more.lines', 1, { lines: '4' })).toBe('E 1 altra: riga 4.');
    language.value = 'zh';
    expect(lines(1)).toBe('1 行');
    language.value = 'en';
  });

  it('finds a language among those that a browser prefers', () => {
    expect(languageOf(['de-CH', 'fr-CH', 'en'])).toBe('fr');
    expect(languageOf(['zh-TW'])).toBe('zh');
    expect(languageOf(['de'])).toBe('en');
  });
});
