import { describe, expect, it } from 'vitest';
import { directionOf } from '../src/machine/gamepad';

const pad = (pressed: number[], axes: number[] = [0, 0, 0, 0], mapping = 'standard'): Parameters<typeof directionOf>[0] => ({
  mapping,
  axes,
  buttons: Array.from({ length: 17 }, (_, i) => ({ pressed: pressed.includes(i) })),
});

describe('a gamepad', () => {
  it('moves by its cross, its shoulder buttons and its sticks', () => {
    expect(directionOf(pad([15]))).toEqual({ x: 1 });
    expect(directionOf(pad([12, 14]))).toEqual({ x: -1, y: 1 });
    expect(directionOf(pad([5]))).toEqual({ z: 1 });
    expect(directionOf(pad([], [0, -0.9, 0, 0]))).toEqual({ y: 1 });
    expect(directionOf(pad([], [0, 0, 0, 1]))).toEqual({ z: -1 });
  });
  it('rests where a stick is hardly touched, and where opposite ways are held', () => {
    expect(directionOf(pad([], [0.3, -0.5, 0.2, 0.1]))).toEqual({});
    expect(directionOf(pad([14, 15]))).toEqual({});
    expect(directionOf(pad([15], [-1, 0, 0, 0]))).toEqual({});
  });
  it('does not guess what an unknown layout means', () => {
    expect(directionOf(pad([15], [1, 0, 0, 0], ''))).toEqual({});
  });
});
