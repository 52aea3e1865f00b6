import { describe, expect, it } from 'vitest';
import { fill, language, languageOf, sayCount, typeset } from '../src/core/language';
import { board } from '../src/lang/en/board';
import { cam } from '../src/lang/en/cam';
import { console as consoleWords } from '../src/lang/en/console';
import { files } from '../src/lang/en/files';
import { frame } from '../src/lang/en/frame';
import { en } from '../src/lang/en/index';
import { job } from '../src/lang/en/job';
import { machine } from '../src/lang/en/machine';
import { operations } from '../src/lang/en/operations';
import { pins } from '../src/lang/en/pins';
import { run } from '../src/lang/en/run';
import { set_up } from '../src/lang/en/set_up';
import { fr } from '../src/lang/fr/index';
import { it as italian } from '../src/lang/it/index';
import { zh } from '../src/lang/zh/index';

const names = (words: string): string[] => (words.match(/\{\w+\}/g) ?? []).sort();

describe('languages', () => {
  it('has the same places for values in each translation', () => {
    const wrong = (table: Record<string, string>): string[] =>
      Object.entries(en)
        .filter(([key, words]) => (table[key] ?? '').trim() === '' || names(table[key] ?? '').join() !== names(words).join())
        .map(([key]) => key);
    expect([italian, fr, zh].map(wrong)).toEqual([[], [], []]);
  });

  it('says each thing once: no file hides a word of another', () => {
    const all = [board, cam, consoleWords, files, frame, job, machine, operations, pins, run, set_up].flatMap((one) => Object.keys(one));
    expect(all.length).toBe(Object.keys(en).length);
    expect(new Set(all).size).toBe(all.length);
  });

  it('fills in values, and leaves what it does not know', () => {
    expect(fill('Line {line} of {lines}', { line: 3 })).toBe('Line 3 of {lines}');
  });

  it('keeps French punctuation on the line of its word, and leaves values and other languages alone', () => {
    const hard = '\u00a0';
    const set = 'État «_Prêt_»_: {name}_; 5_%_? Oui_!';
    expect(typeset(set.replaceAll('_', ' '), 'fr')).toBe(set.replaceAll('_', hard));
    expect(typeset('Wahr : 5 %', 'en')).toBe('Wahr : 5 %');
    language.value = 'fr';
    expect(fill('Nom : {name}', { name: 'a : b' })).toBe(`Nom${hard}: a : b`);
    language.value = 'en';
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
