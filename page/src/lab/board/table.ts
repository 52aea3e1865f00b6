// The machine's table as the computer's program has it: the unit, steps in a unit, lengths of the axes, origin, inversion.

import { type Field, range } from '../field';

export const axisNames = ['X', 'Y', 'Z'] as const;
export type Triple = readonly [number, number, number];

export function tripleField(from: number, to: number, usual: Triple): Field<Triple> {
  return {
    usual,
    read: (text) => {
      const values = text.split(',').map((word) => (word === '' ? NaN : Number(word)));
      const [x, y, z] = values;
      const good = values.length === 3 && values.every((value) => Number.isFinite(value) && value >= from && value <= to);
      return good && x !== undefined && y !== undefined && z !== undefined ? [x, y, z] : undefined;
    },
    write: (value) => value.map((one) => String(Number(one.toPrecision(8)))).join(','),
    expects: `x,y,z: ${range(from, to)}`,
  };
}

// A set of axes: a bit for each, as "xz" in the address.
export function axesField(usual: number): Field<number> {
  return {
    usual,
    read: (text) => (/^(0|x?y?z?)$/.test(text) && text !== '' ? ['x', 'y', 'z'].reduce((set, name, i) => set | (text.includes(name) ? 1 << i : 0), 0) : undefined),
    write: (value) => ['x', 'y', 'z'].filter((_, i) => (value >> i) & 1).join('') || '0',
    expects: '0, x, y, z, xy …',
  };
}

export type Unit = 'mm' | 'inch';
export const mmPerInch = 25.4;

export interface Table {
  unit: Unit;
  perunit: Triple; // steps
  lengths: Triple;
  origin: Triple; // of the program's coordinates, on the axis
  flip: number; // a bit for each axis
  zclear: number;
  zwork: number;
}

// The shortest number within a ten-millionth: what was 60 mm is so again after a time in inches, and after an address of
// eight digits.
function rounded(value: number): number {
  for (let digits = 1; digits < 9; ++digits) {
    const short = Number(value.toPrecision(digits));
    if (Math.abs(short - value) <= 1e-7 * Math.abs(value)) return short;
  }
  return value;
}

// The same table in another unit.
export function inUnit(table: Table, unit: Unit): Table {
  if (table.unit === unit) return table;
  const factor = unit === 'inch' ? 1 / mmPerInch : mmPerInch;
  const lengths = (values: Triple): Triple => [rounded(values[0] * factor), rounded(values[1] * factor), rounded(values[2] * factor)];
  const [x, y, z] = table.perunit;
  return {
    ...table, unit,
    perunit: [rounded(x / factor), rounded(y / factor), rounded(z / factor)],
    lengths: lengths(table.lengths), origin: lengths(table.origin),
    zclear: rounded(table.zclear * factor), zwork: rounded(table.zwork * factor),
  };
}

const signOf = (table: Table, axis: number): number => ((table.flip >> axis) & 1 ? -1 : 1);
const at = (values: Triple, axis: number): number => values[axis] ?? 0;

// Steps of the motor to the program's coordinates, and back.
export const placeOf = (table: Table, axis: number, steps: number): number => (signOf(table, axis) * steps) / at(table.perunit, axis) + 0; // never −0
export const stepsTo = (table: Table, axis: number, place: number): number => signOf(table, axis) * Math.round(place * at(table.perunit, axis));

// The end switch at either end of the axis.
export function atEnd(table: Table, axis: number, steps: number): boolean {
  const along = at(table.origin, axis) + placeOf(table, axis, steps);
  return along <= 0 || along >= at(table.lengths, axis);
}

export const shownPlace = (table: Table, place: number): string => place.toFixed(table.unit === 'mm' ? 2 : 4);
