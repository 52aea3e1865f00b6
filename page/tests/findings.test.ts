// What is found in programs and machine files is translated by codes: each row of the sources has its words here, and no other has.
import { afterEach, describe, expect, it } from 'vitest';
import { faults, findings, reportIn, reportWords, type Sentence } from '../src/core/faults';
import { language } from '../src/core/language';
import { units } from '../src/core/units';
import { source, sources } from './sources';

const valuesOf = (words: string): string[] => [...new Set(words.match(/\{\w+\}/g) ?? [])].sort();
const said = (code: string, values: Record<string, string> = {}): string => reportWords('as the server says it', { code, arguments: values });

// The rows of the sources, by code: SentenceRow name{"code", "English"}. A row without a code is in English only.
const row = /SentenceRow \w+\{\s*"([^"]+)",\s*((?:"(?:[^"\\\n]|\\.)*"\s*)+)\}/g;
const rows = new Map(sources().flatMap((text) => [...text.matchAll(row)].map(([, code = '', words = '']) => [code, words.trim().replace(/"\s*"/g, '').slice(1, -1)] as const)));
const abort = 'probing.bores-apart'; // a program's own text

afterEach(() => {
  language.value = 'en';
  units.value = 'mm';
});

describe('a finding', () => {
  it('has its English words from the sources, code by code', () => {
    expect(rows.size).toBeGreaterThan(150);
    const { [abort]: _, ...here } = findings.en;
    expect(here).toEqual(Object.fromEntries([...rows].map(([code, words]) => [code, words.replaceAll('\\"', '"').replaceAll("'", '’')])));
  }, 30_000); // it reads all sources

  it('has its values in each language', () => {
    const codes = Object.keys(findings.en) as (keyof typeof findings.en)[];
    const wrong = [findings.fr, findings.it, findings.zh].map((table) => codes.filter((one) => valuesOf(table[one]).join() !== valuesOf(findings.en[one]).join()));
    expect(wrong).toEqual([[], [], []]);
  });

  it('has no code of a fault', () => {
    expect(Object.keys(findings.en).filter((code) => code in faults.en)).toEqual([]);
  });

  it('is said in the language of the page, with its values', () => {
    language.value = 'it';
    const far = { axis: 'X', reached: '9.000', work: '9.000', far: '1.000 mm', end: '8.000' };
    expect(said('travel.exceeded.high', far)).toBe('X arriverebbe a 9.000 (pezzo 9.000), 1.000 mm oltre la fine della corsa a 8.000');
    language.value = 'fr';
    expect(said('gcode.missing-feed')).toBe('aucune avance n’est donnée');
    expect(said('file.not-gcode.printer')).toBe('ceci est un programme pour une imprimante 3D, pas du G-code');
    language.value = 'zh';
    expect(said('machine.bad-value', { key: 'X.microsteps', value: '0' })).toBe('X.microsteps 为 0');
    expect(reportIn({ words: 'nobody knows this sentence', sentence: { code: '', arguments: {} } })).toBeNull();
  });

  it('is shown in the units of the page', () => {
    units.value = 'inch';
    expect(said('path.low-rapid', { z: '25.4', cut: '-25.4' })).toBe('a rapid moves sideways at Z1.0000, where there may be material: the program has cut at Z-1.0000');
  });

  it('is said within the sentence that holds it', () => {
    language.value = 'fr';
    const held: Sentence = {
      code: 'machine-file.unsound',
      arguments: { finding: 'X.microsteps is 0', 'finding.code': 'machine.bad-value', 'finding.arguments.key': 'X.microsteps', 'finding.arguments.value': '0' },
    };
    expect(reportWords('', held)).toBe('');
    expect(reportWords('invalid machine file: X.microsteps is 0', held)).toContain('X.microsteps vaut 0');
    expect(said('machine-file.unsound', { finding: 'words without a code' })).toContain('words without a code');
  });
});

describe('a program that aborts', () => {
  it('says its own words; those of a probing cycle are known', () => {
    expect(source('cam/probing/cycle_text.cpp')).toContain('the bores are #<apart> mm apart; they should be {:.4f} mm apart');
    language.value = 'fr';
    expect(said('gcode.abort', { words: ' the bores are 69.1 mm apart; they should be 70.0000 mm apart' })).toBe(
      'le programme abandonne\u00a0: les alésages sont à 69.1 mm l’un de l’autre au lieu de 70.0000 mm',
    );
    expect(said('gcode.abort', { words: ' no stock' })).toBe('le programme abandonne\u00a0: no stock');
  });
});
