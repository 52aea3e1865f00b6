import { describe, expect, it } from 'vitest';
import { durationText } from '../src/core/time';
import { placeText, readLength, speedText, units } from '../src/core/units';
import type { Status } from '../src/machine/api';
import { status } from '../src/machine/connection';
import { inWork, turned, workPlace } from '../src/machine/place';

describe('units', () => {
  it('shows a place in mm and in inches, never a negative zero', () => {
    units.value = 'mm';
    expect(placeText('x', 12.3456)).toBe('12.346');
    expect(placeText('x', -0.0001)).toBe('0.000');
    expect(speedText(600)).toBe('600');
    units.value = 'inch';
    expect(placeText('x', 25.4)).toBe('1.0000');
    expect(placeText('a', 90)).toBe('90.000');
    expect(speedText(254)).toBe('10.0');
    units.value = 'mm';
  });

  it('reads what a person types, with a point or a comma', () => {
    expect(readLength(' 1,5 ')).toBe(1.5);
    expect(readLength('-.5')).toBe(-0.5);
    expect(readLength('1e9')).toBeUndefined();
    expect(readLength('')).toBeUndefined();
    units.value = 'inch';
    expect(readLength('1')).toBe(25.4);
    units.value = 'mm';
  });

  it('shows durations as a clock does', () => {
    expect(durationText(0)).toBe('0:00');
    expect(durationText(59.6)).toBe('1:00');
    expect(durationText(3725)).toBe('1:02:05');
  });
});

describe('the place in the work', () => {
  it('is along the axes of the work, which may be turned', () => {
    const close = (place: Record<string, number>) => Object.values(place).map((value) => Math.round(value * 1e6) / 1e6 + 0);
    expect(close(inWork({ x: 5, y: 7, z: 1 }, { x: 5, y: 5, z: 3 }, 0))).toEqual([0, 2, -2]);
    expect(close(inWork({ x: 5, y: 7, z: 1 }, { x: 5, y: 5, z: 3 }, 90))).toEqual([2, 0, -2]);
    expect(close(inWork({ x: 10, a: 4 }, { x: 1 }, 30))).toEqual([9, 4]);
    const [x, y] = turned(...turned(3, 4, 12.5), -12.5);
    expect([x, y]).toEqual([expect.closeTo(3, 9), expect.closeTo(4, 9)]);
  });

  it('is that of the program while one runs, with the offset of its tool', () => {
    const told = (program_zero: Status['program_zero']): Record<string, number> => {
      status.value = { place: { x: 5, z: 30 }, work_offset: { x: 1, z: 2 }, program_zero } as unknown as Status;
      return workPlace.value;
    };
    expect(told(null)).toEqual({ x: 4, z: 28 });
    expect(told({ x: 1, z: 27 })).toEqual({ x: 4, z: 3 });
    expect(told(undefined)).toEqual({ x: 4, z: 28 });
    status.value = null;
  });
});
