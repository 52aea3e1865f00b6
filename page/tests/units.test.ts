import { describe, expect, it } from 'vitest';
import { durationText } from '../src/core/time';
import { placeText, readLength, speedText, units } from '../src/core/units';

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
