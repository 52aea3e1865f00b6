// What stands around the path: the grid at the work's zero, the travel, and the axes.
import { turned } from '../machine/place';
import type { Vector } from './path_data';

export interface Line {
  from: Vector;
  to: Vector;
  colour: readonly [number, number, number];
  width: number;
}
type Colour = readonly [number, number, number];

// 1, 2 or 5 times a power of ten: so many mm between two lines of the grid.
export function gridStep(extent: number): number {
  const rough = Math.max(extent, 1) / 12;
  const power = 10 ** Math.floor(Math.log10(rough));
  const share = rough / power;
  return power * (share > 5 ? 10 : share > 2 ? 5 : share > 1 ? 2 : 1);
}

export function grid(low: Vector, high: Vector, zero: Vector, step: number, colour: Colour): Line[] {
  const lines: Line[] = [];
  const height = zero[2];
  for (const [along, across] of [[0, 1], [1, 0]] as const) {
    const first = Math.ceil((low[along] - zero[along]) / step);
    const last = Math.floor((high[along] - zero[along]) / step);
    for (let i = first; i <= Math.min(last, first + 400); ++i) {
      const from: Vector = [0, 0, height];
      const to: Vector = [0, 0, height];
      from[along] = to[along] = zero[along] + i * step;
      from[across] = low[across];
      to[across] = high[across];
      lines.push({ from, to, colour, width: i % 5 === 0 ? 1.6 : 1 });
    }
  }
  return lines;
}

export function box(low: Vector, high: Vector, colour: Colour): Line[] {
  const lines: Line[] = [];
  for (let corner = 0; corner < 8; ++corner) {
    for (const axis of [0, 1, 2] as const) {
      if (corner & (1 << axis)) continue;
      const pick = (c: number): Vector => [0, 1, 2].map((k) => (c & (1 << k) ? high[k]! : low[k]!)) as Vector;
      lines.push({ from: pick(corner), to: pick(corner | (1 << axis)), colour, width: 1.2 });
    }
  }
  return lines;
}

// The ends of the axes of the work, whose X and Y are turned.
export function triadEnds([x, y, z]: Vector, length: number, degrees: number): [Vector, Vector, Vector] {
  const [along, across] = turned(length, 0, degrees);
  return [
    [x + along, y + across, z],
    [x - across, y + along, z],
    [x, y, z + length],
  ];
}
export function triad(zero: Vector, length: number, degrees: number, colours: readonly [Colour, Colour, Colour]): Line[] {
  return triadEnds(zero, length, degrees).map((to, k) => ({ from: zero, to, colour: colours[k]!, width: 3 }));
}

// Ten numbers a line, for each of its six vertices: from, to, colour, width.
export function asNumbers(lines: readonly Line[]): Float32Array {
  const numbers = new Float32Array(lines.length * 60);
  lines.forEach((one, i) => {
    const ten = [...one.from, ...one.to, ...one.colour, one.width];
    for (let vertex = 0; vertex < 6; ++vertex) numbers.set(ten, i * 60 + vertex * 10);
  });
  return numbers;
}

// A cone with its tip at the zero, one long, with normals: triangles.
export function cone(sides = 24): Float32Array {
  const numbers: number[] = [];
  const radius = 0.26;
  const at = (i: number): [number, number] => {
    const angle = (i / sides) * 2 * Math.PI;
    return [Math.cos(angle), Math.sin(angle)];
  };
  for (let i = 0; i < sides; ++i) {
    const [ax, ay] = at(i);
    const [bx, by] = at(i + 1);
    numbers.push(0, 0, 0, ax, ay, -0.3, ax * radius, ay * radius, 1, ax, ay, -0.3, bx * radius, by * radius, 1, bx, by, -0.3);
    numbers.push(0, 0, 1, 0, 0, 1, ax * radius, ay * radius, 1, 0, 0, 1, bx * radius, by * radius, 1, 0, 0, 1);
  }
  return new Float32Array(numbers);
}
