// What is found in programs is translated by its sentence: they are those of the sources, and each language keeps their values.
import { afterEach, describe, expect, it } from 'vitest';
import { findingIn, findings, type FindingKey } from '../src/core/findings';
import { language } from '../src/core/language';
import { sources, textsOf } from './sources';

const valuesOf = (words: string): string[] => (words.match(/\{\w+\}/g) ?? []).sort();

afterEach(() => (language.value = 'en'));

describe('a finding', () => {
  it('is one of the sources, piece by piece', () => {
    const texts = textsOf(sources()).join('\n');
    const strange = Object.values(findings.en).flatMap((one) =>
      one
        .split(/\{\w+\}|\|/)
        .map((piece) => piece.replaceAll('’', "'").trim())
        .filter((piece) => piece.length > 3 && !texts.includes(piece)),
    );
    expect(strange).toEqual([]);
  }, 30_000); // it reads all sources

  it('has its values in each language', () => {
    for (const table of [findings.fr, findings.it, findings.zh]) {
      const wrong = (Object.keys(findings.en) as FindingKey[]).filter((key) => valuesOf(table[key]).some((value) => !valuesOf(findings.en[key]).includes(value)));
      expect(wrong).toEqual([]);
    }
  });

  it('has all that the check finds of other controls and of frequent mistakes', () => {
    language.value = 'fr';
    const all = [
      'X20 5 is read as X205', '#101 was never set, and is 0', 'this move comes after the end of the program, and is never made',
      'G28 uses the axis words of the block; G0 only stays in force', 'G28 in a block without G0', "the spindle is still on where '%' ends the program",
      'a rapid goes down to Z-5 before the program has given X or Y', 'no feed goes below Z0: the lowest is Z2',
      'this arc is nearly a full circle, and ends 0.01 mm before its start', "WHILE is a word of Fanuc's macros", "GOTO is a word of Fanuc's macros",
      'o1 while [...] on one line, and o1 endwhile where END stands', "':' where a word should start",
      "O for ':', as in O0491; on some controls ':' begins the number of a program", 'there is no G68', 'G10 L2 with R, which rotates a work system',
      'this is a program for a 3D printer, not G-code', "the arc's start and end are not equally far from its centre, which is a distance from the start (G91.1) here",
      "I and J, or the plane's code before; grbl ignores the word: --dialect grbl",
    ];
    expect(all.filter((words) => findingIn(words) === null)).toEqual([]);
    expect(findingIn('this is a program for a 3D printer, not G-code')).toBe('ceci est un programme pour une imprimante 3D, pas du G-code');
  });

  it('is said in the language of the page, with its values', () => {
    language.value = 'it';
    expect(findingIn('X would reach 9.000 (work 9.000), 1.000 mm beyond its travel\'s end at 8.000')).toBe('X arriverebbe a 9.000 (pezzo 9.000), 1.000 mm oltre la fine della corsa a 8.000');
    expect(findingIn('Z would reach -12.000 (work -2.000), 2.000 mm below its travel\'s end at -10.000')).toBe(
      'Z arriverebbe a -12.000 (pezzo -2.000), 2.000 mm sotto la fine della corsa a -10.000',
    );
    language.value = 'fr';
    expect(findingIn('the program aborts: the bores are 69.1 mm apart; they should be 70.0000 mm apart')).toBe(
      'le programme abandonne\u00a0: les trous sont à 69.1 mm l’un de l’autre au lieu de 70.0000 mm',
    );
    expect(findingIn('no feed rate is set')).toBe('aucune avance n’est donnée');
    language.value = 'zh';
    expect(findingIn('X.microsteps is 0')).toBe('X.microsteps 为 0');
    expect(findingIn('nobody knows this sentence')).toBeNull();
  });
});
