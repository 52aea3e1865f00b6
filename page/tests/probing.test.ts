import { describe, expect, it } from 'vitest';
import { fields, fieldsOf, kinds, waysOf } from '../src/machine/probing';
import { description } from './description';
import { viewsOf } from '../src/parts/cycle_picture';
import { readLoads } from '../src/machine/studies';
import { blockOf, cellOf } from '../src/scene/stock_cutter';
import { noteLoads, type PathPoints } from '../src/scene/path_data';

interface Numbers {
  properties: Record<string, { default: number; minimum: number; maximum: number; 'x-cycles': string[] }>;
}
const usual = (kind: (typeof kinds)[number]): Record<string, number> => Object.fromEntries(fieldsOf(kind).map((one) => [one.name, one.usual]));

describe('the picture of a cycle', () => {
  it('has finite places and each touch on its way, for each side', () => {
    for (const kind of kinds) {
      for (const side of waysOf[kind] ?? ['']) {
        for (const view of viewsOf(kind, side, usual(kind))) {
          for (const [x, y] of [...view.way, ...view.touches, ...view.found, ...view.work.flat()]) {
            expect(Number.isFinite(x) && Number.isFinite(y), `${kind} ${side}`).toBe(true);
          }
          for (const touch of view.touches) expect(view.way, `${kind} ${side}`).toContainEqual(touch);
        }
      }
    }
  });
  it('follows the side: an edge is touched from outside, a corner lies at the zero', () => {
    const towards = (side: string): readonly number[] => viewsOf('edge', side, usual('edge'))[0]?.way[0] ?? [];
    expect(towards('x+')[0]).toBeLessThan(0);
    expect(towards('x-')[0]).toBeGreaterThan(0);
    expect(towards('y+')[1]).toBeLessThan(0);
    const corner = viewsOf('corner', 'back-right', usual('corner'))[0];
    expect(corner?.touches[1]).toEqual([0, -10]);
    expect(corner?.found[0]).toEqual([0, 0]);
  });
  it('follows the figures', () => {
    const map = viewsOf('map', '', { ...usual('map'), columns: 3, rows: 2, size_x: 40, size_y: 30, x: 5, y: 1 })[0];
    expect(map?.touches).toEqual([[5, 1], [25, 1], [45, 1], [45, 31], [25, 31], [5, 31]]);
  });
  it('has the ranges and usual values of the daemon', () => {
    const { ProbingNumbers } = description().components.schemas as unknown as { ProbingNumbers: Numbers };
    expect(fields.map((one) => one.name).sort()).toEqual(Object.keys(ProbingNumbers.properties).sort());
    for (const one of fields) {
      const daemon = ProbingNumbers.properties[one.name];
      expect({ default: one.usual, minimum: one.low, maximum: one.high }, one.name).toMatchObject({ default: daemon?.default, minimum: daemon?.minimum, maximum: daemon?.maximum });
      expect(daemon?.['x-cycles'], one.name).toEqual(expect.arrayContaining([...one.of]));
    }
  });
});

describe('the torque of lines', () => {
  it('is read as the daemon writes it, and noted in the flags of the path', () => {
    const loads = readLoads('line,load\n3,0.500\n10,0.038\n12,9.999\n');
    expect([loads.length, loads[3], loads[4], loads[10], loads[12]]).toEqual([13, 51, 0, 5, 1001]);
    expect(readLoads('line,load\n').length).toBe(1);
    const points = { count: 3, lines: new Uint32Array([3, 4, 12]), places: new Uint16Array(12).fill(0x5001) } as unknown as PathPoints;
    noteLoads(points, loads);
    expect([points.places[3], points.places[7], points.places[11]]).toEqual([0x5001 | (26 << 1), 0x5001, 0x5001 | (127 << 1)]);
  });
});

describe('the block of the stock', () => {
  it('is what the feeds need, in round cells that a scene can draw', () => {
    const block = blockOf({ low: [0, 0, -6], high: [100, 50, 1] }, 0, 3);
    expect(block).toEqual({ low: [-1.5, -1.5, -7.5], high: [101.5, 51.5, 0] });
    const cell = cellOf(block);
    expect((103 / cell) * (53 / cell)).toBeLessThan(200_001);
    expect([0.1, 0.2, 0.5]).toContainEqual(Number(cell.toFixed(6)));
    // Nothing goes below the work's zero: the top is above the deepest cut all the same.
    expect(blockOf({ low: [0, 0, 5], high: [1, 1, 5] }, 0, 3).high[2]).toBeGreaterThan(5);
  });
});
