// Lengths are mm inside, as in the API. A person sees mm or inches.
import { kept, oneOf } from './kept';

export type Units = 'mm' | 'inch';
export const units = kept<Units>('units', 'mm', oneOf('mm', 'inch'));

const mmAnInch = 25.4;
const perMm = (): number => (units.value === 'inch' ? 1 / mmAnInch : 1);

// Rotary axes are in degrees, whatever the units of lengths.
export const isRotary = (axis: string): boolean => 'abc'.includes(axis);

export const lengthUnit = (): string => (units.value === 'inch' ? 'in' : 'mm');
export const speedUnit = (): string => (units.value === 'inch' ? 'in/min' : 'mm/min');
const placeDecimals = (): number => (units.value === 'inch' ? 4 : 3);

// Never "-0.000".
function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? (0).toFixed(decimals) : text;
}

export function placeText(axis: string, value: number): string {
  return isRotary(axis) ? fixed(value, 3) : fixed(value * perMm(), placeDecimals());
}
export function lengthText(mm: number, decimals = units.value === 'inch' ? 3 : 1): string {
  return fixed(mm * perMm(), decimals);
}
export function speedText(mmAMinute: number): string {
  return fixed(mmAMinute * perMm(), units.value === 'inch' ? 1 : 0);
}
export const toMm = (shown: number): number => shown / perMm();
// A count for each mm, as one for each shown unit.
export const perLength = (perMillimetre: number): number => perMillimetre / perMm();
// A thousandth of the unit.
export const smallUnit = (): string => (units.value === 'inch' ? 'mil' : 'µm');
export const fromMm = (mm: number): number => mm * perMm();

// What a person typed, in the shown units, as mm. A comma may stand for the point.
export function readLength(text: string): number | undefined {
  const plain = text.trim().replace(',', '.');
  if (!/^[-+]?(\d+\.?\d*|\.\d+)$/.test(plain)) return undefined;
  return toMm(Number(plain));
}
