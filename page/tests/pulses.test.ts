import { describe, expect, it } from 'vitest';
import { pulsesOf, readPulses, timeWords, upTo, windingsAt, zoomed } from '../src/machine/pulses';

// Motor 0 steps up at 1, 2, 3 and 4 ms; motor 1 steps down at 2 ms.
function answer(): ArrayBuffer {
  const pulses = [
    [16_000, 1, 0],
    [32_000, 3, 2],
    [48_000, 1, 0],
    [64_000, 1, 0],
  ] as const;
  const bytes = new ArrayBuffer(80 + 8 * pulses.length);
  const view = new DataView(bytes);
  [5, 5.01, 1, 9, 1 / 16e6].forEach((value, i) => view.setFloat64(8 * i, value, true));
  view.setInt32(40, 100, true);
  view.setInt32(44, -7, true);
  view.setUint32(72, pulses.length, true);
  view.setUint32(76, 2, true);
  pulses.forEach(([ticks, stepped, down], i) => {
    view.setUint32(80 + 8 * i, ticks, true);
    view.setUint8(84 + 8 * i, stepped);
    view.setUint8(85 + 8 * i, down);
  });
  return bytes;
}

describe('single pulses', () => {
  it('are read as the daemon writes them', () => {
    const read = readPulses(answer());
    expect([read.begin, read.end, read.oldest, read.newest, read.motors]).toEqual([5, 5.01, 1, 9, 2]);
    const x = pulsesOf(read, 0);
    expect(x.at.map((at) => Number((at - 5).toFixed(6)))).toEqual([0.001, 0.002, 0.003, 0.004]);
    expect([x.before, ...x.counts]).toEqual([100, 101, 102, 103, 104]);
    const y = pulsesOf(read, 1);
    expect([y.up, y.counts]).toEqual([[false], [-8]]);
    expect(() => readPulses(answer().slice(0, 90))).toThrow();
    expect(() => readPulses(new ArrayBuffer(3))).toThrow();
  });

  it('turn the field once in four full steps', () => {
    expect(windingsAt(0, 16)).toEqual([1, 0]);
    expect(windingsAt(16, 16)[1]).toBeCloseTo(1);
    expect(windingsAt(64, 16)[0]).toBeCloseTo(1);
    expect(windingsAt(-1, 1)[1]).toBeCloseTo(-1);
  });

  it('are found by their time, and zoomed about a place', () => {
    expect([upTo([1, 2, 3], 0), upTo([1, 2, 3], 2), upTo([1, 2, 3], 9)]).toEqual([0, 2, 3]);
    expect(zoomed({ from: 0, to: 4 }, 0.5, 1)).toEqual({ from: 0.5, to: 2.5 });
    const least = zoomed({ from: 0, to: 1e-6 }, 0.1, 0);
    expect(least.to - least.from).toBeCloseTo(2e-6, 12);
  });

  it('have times in units that suit', () => {
    expect([timeWords(0.0000125), timeWords(0.0125), timeWords(2.5)]).toEqual(['12.5 µs', '12.5 ms', '2.5 s']);
  });
});
