import { describe, expect, it } from 'vitest';
import { RemainingTime } from '../src/machine/remaining';

describe('RemainingTime', () => {
  it('begins with the programmed speeds, and ends with the real pace', () => {
    const left = new RemainingTime();
    expect(left.tell(0, 0, 100, true)).toBe(100);
    let last: number | undefined;
    // It really takes twice as long.
    for (let t = 0; t <= 60; ++t) last = left.tell(t, t / 200, 100, true);
    expect(last).toBeCloseTo(140, 0);
  });

  it('does not count a hold', () => {
    const left = new RemainingTime();
    for (let t = 0; t <= 30; ++t) left.tell(t, t / 100, 100, true);
    for (let t = 30; t <= 90; ++t) left.tell(t, 0.3, 100, false);
    expect(left.tell(91, 0.3, 100, true)).toBeCloseTo(70, 0);
  });

  it('begins anew with another job, and knows nothing without progress', () => {
    const left = new RemainingTime();
    for (let t = 0; t <= 30; ++t) left.tell(t, t / 50, 100, true);
    expect(left.tell(31, 0, 80, true)).toBe(80);
    expect(left.tell(32, null, 80, true)).toBeUndefined();
  });
});
