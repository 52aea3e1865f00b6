// What the daemon says is translated by its sentences: they are those of its sources, and each language keeps their values.
import { readdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { afterEach, describe, expect, it } from 'vitest';
import { language } from '../src/core/language';
import { sayings, told } from '../src/core/told';

const root = resolve(import.meta.dirname, '../../src');

// All texts of the program, those that stand side by side joined.
function textsOfSources(): string {
  const files = readdirSync(root, { recursive: true, encoding: 'utf8' }).filter((name) => /\.(cpp|hpp)$/.test(name) && !name.includes('tests/'));
  const texts = files.flatMap((name) => [...readFileSync(join(root, name), 'utf8').matchAll(/"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*/g)]);
  return texts.map((one) => one[0].replace(/"\s*"/g, '').slice(1, -1)).join('\n');
}
const valuesOf = (words: string): string[] => (words.match(/\{\w+\}/g) ?? []).sort();

afterEach(() => (language.value = 'en'));

describe('a sentence of the daemon', () => {
  it('is one of its sources, piece by piece', () => {
    const texts = textsOfSources();
    const strange = sayings.flatMap((one) =>
      one.en
        .split(/\{\w+\}|\|/)
        .map((piece) => piece.replaceAll('’', "'").trim())
        .filter((piece) => piece.length > 3 && !texts.includes(piece)),
    );
    expect(strange).toEqual([]);
  });

  it('has its values in each language', () => {
    const wrong = sayings.filter((one) => [one.fr, one.it, one.zh].some((words) => words === '' || valuesOf(words).some((value) => !valuesOf(one.en).includes(value))));
    expect(wrong).toEqual([]);
  });

  it('has all that the check finds of other controls and of frequent mistakes', () => {
    language.value = 'fr';
    const all = [
      'X20 5 is read as X205', '#101 was never set, and is 0', 'this move comes after the end of the program, and is never made',
      'G28 takes the axis words of the block; G0 only stays in force', 'G28 in a block without G0', "the spindle is still on where '%' ends the program",
      'a rapid goes down to Z-5 before the program has given X or Y', 'no feed goes below Z0: the lowest is Z2',
      'this arc goes round nearly a full circle, and ends 0.01 mm before its start', "WHILE is a word of Fanuc's macros", "GOTO is a word of Fanuc's macros",
      'o1 while [...] on one line, and o1 endwhile where END stands', "':' where a word should start",
      "O for ':', as in O0491; on some controls ':' begins the number of a program", 'there is no G68', 'G10 L2 with R, which turns a work system',
      'this is a program for a 3D printer, not G-code', "the arc's start and end are not equally far from its centre, which is a distance from the start (G91.1) here",
      "I and J, or the plane's code before; grbl ignores the word: --dialect grbl",
    ];
    expect(all.filter((words) => told(words) === null)).toEqual([]);
    expect(told('this is a program for a 3D printer, not G-code')).toBe('ceci est un programme pour une imprimante 3D, pas du G-code');
  });

  it('is said in the language of the page, with its values', () => {
    language.value = 'it';
    expect(told('line 7: X would reach 9.000 (work 9.000), 1.000 mm beyond its travel\'s end at 8.000 [travel.exceeded]')).toBe(
      'riga 7: X arriverebbe a 9.000 (pezzo 9.000), 1.000 mm oltre la fine della corsa a 8.000 [travel.exceeded]',
    );
    expect(told('Z would reach -12.000 (work -2.000), 2.000 mm below its travel\'s end at -10.000')).toBe(
      'Z arriverebbe a -12.000 (pezzo -2.000), 2.000 mm sotto la fine della corsa a -10.000',
    );
    language.value = 'fr';
    expect(told('the machine is not idle: Run')).toBe('la machine n’est pas au repos : Usinage en cours');
    expect(told('line 9: the program gives up: the bores are 69.1 mm apart; they should be 70.0000 mm apart [gcode.abort]')).toBe(
      'ligne 9 : le programme abandonne : les trous sont à 69.1 mm l’un de l’autre au lieu de 70.0000 mm [gcode.abort]',
    );
    expect(told('line 3: no feed rate is set [gcode.missing-feed]')).toBe('ligne 3 : aucune avance n’est donnée [gcode.missing-feed]');
    language.value = 'zh';
    expect(told('X.microsteps is 0')).toBe('X.microsteps 为 0');
    expect(told('nobody knows this sentence')).toBeNull();
  });
});
