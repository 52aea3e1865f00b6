import { describe, expect, it } from 'vitest';
import { language } from '../src/core/language';
import { nearest, niceStep, ticksOf } from '../src/lab/Chart';
import { boardLines, conflictIn, restingRegisters, wiringField, withBoardLines, withLine } from '../src/lab/board/port';
import { atEnd, inUnit, placeOf, stepsTo, type Table } from '../src/lab/board/table';
import { beatAt, shareOf } from '../src/lab/play';
import { fields, methodCodes, methodsFor, moveOf, onCircle, readView, refusedIn, rightOf, writeView } from '../src/lab/view';
import { labTables, refusal } from '../src/lab/words';

const read = (text: string) => readView(new URLSearchParams(text));
const pickTable = ({ unit, perunit, lengths, origin, flip, zclear, zwork }: Table): Table => ({ unit, perunit, lengths, origin, flip, zclear, zwork });
const names = (words: string): string[] => (words.match(/\{\w+\}/g) ?? []).sort();

describe('the lab in the address', () => {
  it('is reproduced by a link, which says only what is not as usual', () => {
    const link = 'to=13%2C-7&a=point-comparison&b=lean&beat=9&drive=half-step';
    expect(writeView(read(link)).toString()).toBe(link);
    expect(writeView(read('')).toString()).toBe('');
  });

  it('takes the usual for what makes no sense', () => {
    const view = read('to=1e9,2&a=nothing&beat=-3&accel=NaN&part=secret&kp=&move=yes');
    expect(view).toEqual(read(''));
    expect(read('to=0,0').to).not.toEqual([0, 0]);
  });

  it('names what makes no sense', () => {
    expect(refusedIn(new URLSearchParams('to=201,1&a=lean&beat=x&kp=0.1'))).toEqual([
      { name: 'to', text: '201,1', expects: 'x,y[,z…]: −200 … 200' },
      { name: 'beat', text: 'x', expects: '0 … 99999' },
    ]);
  });

  it('has two to eight motors, of which the grid shows two', () => {
    expect(read('to=10,4,7&across=z&up=z')).toMatchObject({ to: [10, 4, 7], across: 'z', up: 'y' });
    expect(read('to=10,4&up=z')).toMatchObject({ across: 'x', up: 'y' });
    expect(read('to=1,2,3,4,5,6,7,8,9').to).toEqual([10, 4]);
    expect(moveOf(read('to=10,4,7')).ends).toEqual([10, 4, 7]);
    expect(read('to=10,4,7&a=slope-blocks').a).toBe('lean');
  });

  it('knows the right method beside each faulty listing', () => {
    const listings = methodCodes.filter((code) => code.startsWith('listing:'));
    expect(listings.length).toBe(4);
    for (const listing of listings) expect(methodsFor('line')).toContain(rightOf(listing));
    expect(rightOf('lean')).toBeUndefined();
    expect(read('a=listing:rounding&to=22,15').b).toBe('lean');
  });

  it('keeps methods to those that take the shape', () => {
    expect(read('shape=arc&a=lean&b=slope-blocks')).toMatchObject({ a: 'midpoint', b: 'none' });
    expect(methodsFor('line')).not.toContain('midpoint');
  });

  it('writes each field as it reads it', () => {
    for (const field of Object.values(fields) as { usual: unknown; read: (text: string) => unknown; write: (value: unknown) => string }[]) {
      expect(field.read(field.write(field.usual))).toEqual(field.usual);
    }
  });
});

describe('the end of an arc', () => {
  it('is less than a step from its circle, wherever it is dragged', () => {
    let worst = 0;
    for (let radius = 1; radius <= 60; ++radius) {
      for (let i = 0; i < 200; ++i) {
        const place: [number, number] = [Math.round(70 * Math.cos(i * 1.7)), Math.round(45 * Math.sin(i * 0.9))];
        const [x, y] = onCircle(radius, place);
        worst = Math.max(worst, Math.abs(Math.hypot(x, y) - radius), Number.isInteger(x) && Number.isInteger(y) ? 0 : 1);
      }
    }
    expect(worst).toBeLessThan(1);
  });
  it('becomes the end of the move', () => {
    expect(moveOf(read('shape=arc&radius=5&end=0,9&cw=1'))).toEqual({
      from: { x: 5, y: 0 }, to: { x: 0, y: 5 }, arc: { centre: { x: 0, y: 0 }, clockwise: true },
    });
  });
});

describe('playing', () => {
  it('counts the pulses that have come', () => {
    const clock = [0.25, 0.5, 0.5, 1];
    expect([0, 0.24, 0.25, 0.6, 1].map((share) => beatAt(clock, share))).toEqual([0, 0, 1, 3, 4]);
    expect([0, 1, 4, 99].map((beat) => shareOf(clock, beat))).toEqual([0, 0.25, 1, 1]);
  });
});

describe('charts', () => {
  it('has round ticks within the axis', () => {
    expect(niceStep(900, 5)).toBe(200);
    expect(ticksOf(0, 1, 5)).toEqual([0, 0.2, 0.4, 0.6000000000000001, 0.8, 1]);
  });
  it('finds the nearest entry', () => {
    expect([-1, 0.4, 0.6, 9].map((at) => nearest([0, 1, 2], at))).toEqual([0, 0, 1, 2]);
  });
});

describe('the first board’s port', () => {
  const usual = wiringField.usual;
  it('is as its table has it: the bits that the port inverts are 1 while their pins are low', () => {
    const resting = restingRegisters(usual);
    expect([resting.data, resting.control & 0xf]).toEqual([0x00, 0x0b]);
    const lines = withBoardLines(usual, resting, 0b1_010_001);
    expect(lines.data).toBe(0x51);
    expect(boardLines(usual, lines)).toBe(0b1_010_001);
  });
  it('carries a line on an inverted bit, inverted by the program too', () => {
    const wiring = wiringField.read('14i.3.4.5.6.7.8.10.12.13.15.11');
    expect(wiring).toBeDefined();
    if (wiring === undefined) return;
    const on = withLine(wiring, restingRegisters(wiring), 'clockX', true);
    expect(boardLines(wiring, on) & 1).toBe(0); // inverted: low while it is on
    expect(on.control & 2).toBe(2); // and the bit is the inverse of the pin
    expect(wiringField.write(wiring)).toBe('14i.3.4.5.6.7.8.10.12.13.15.11');
  });
  it('refuses two lines on one pin, and lines on pins of the other direction', () => {
    expect(conflictIn({ ...usual, clockY: { pin: 2, inverted: false } })).toEqual(['clockX', 'clockY']);
    expect(conflictIn(usual)).toBeUndefined();
    expect(wiringField.read('2.2.4.5.6.7.8.10.12.13.15.11')).toBeUndefined();
    expect(wiringField.read('10.3.4.5.6.7.8.2.12.13.15.11')).toBeUndefined();
    expect(wiringField.read('0.3.4.5.6.7.8.0.0.0.0.0')?.clockX.pin).toBe(0);
  });
});

describe('the machine’s table', () => {
  const table: Table = { unit: 'mm', perunit: [50, 50, 50], lengths: [110, 110, 60], origin: [10, 10, 50], flip: 4, zclear: 2, zwork: -3 };
  it('is the same in inches', () => {
    const inches = inUnit(table, 'inch');
    expect(inches.perunit[0]).toBe(1270);
    expect(placeOf(inches, 0, 1270)).toBeCloseTo(1, 9);
    expect(inUnit(inches, 'mm')).toEqual(table);
  });
  it('keeps its values after a time in the other unit, also through an address', () => {
    for (const perunit of [50, 47.5, 133.333]) {
      for (const length of [60, 110, 0.5, 123.45, 99.999, 1e5]) {
        const before: Table = { ...table, perunit: [perunit, 50, 50], lengths: [length, 1, 2], zclear: -2.375 };
        const there = inUnit(before, 'inch');
        const link = writeView({ ...read(''), ...there });
        expect(inUnit(there, 'mm')).toEqual(before);
        expect(inUnit(pickTable(readView(link)), 'mm')).toEqual(before);
      }
    }
    const inches: Table = { ...table, unit: 'inch', lengths: [4.3307, 2.5, 0.125], zwork: -0.118 };
    expect(inUnit(inUnit(inches, 'mm'), 'inch')).toEqual(inches);
  });
  it('counts a flipped axis the other way, and knows its ends', () => {
    expect(placeOf(table, 2, -150)).toBe(3);
    expect(stepsTo(table, 2, -3)).toBe(150);
    expect([atEnd(table, 2, -500), atEnd(table, 2, -499), atEnd(table, 0, -500), atEnd(table, 0, 0)]).toEqual([true, false, true, false]);
  });
  it('is in the address', () => {
    expect(read('flip=xz&axes=0&unit=inch&perunit=1270,1270,1270')).toMatchObject({ flip: 5, axes: 0, unit: 'inch', perunit: [1270, 1270, 1270] });
    expect(read('flip=zx&perunit=1,2').flip).toBe(4);
  });
});

describe('words', () => {
  it('gives the usual reasons of the program in each language, and of the others that the values do not fit', () => {
    const before = language.value;
    for (const one of ['it', 'fr', 'zh'] as const) {
      language.value = one;
      expect(refusal("the logic's voltage must be above the base's")).toBe(labTables[one].reasonLogic);
      expect(refusal('slope in blocks divides by zero if an axis does not move')).toBe(labTables[one].reasonAxisStill);
      expect(refusal('another reason')).toBe(labTables[one].refused);
    }
    language.value = before;
  });
  it('has the same places for values in each translation', () => {
    for (const table of Object.values(labTables)) {
      for (const key of Object.keys(labTables.en) as (keyof typeof labTables.en)[]) {
        expect(names(table[key]), key).toEqual(names(labTables.en[key]));
        expect(table[key].trim(), key).not.toBe('');
      }
    }
  });
});
