// What a probing cycle will do, as places: the work from above and from its side, and the probe's way with its touches.
// Lengths are mm, in the order and with the figures of the daemon's cycle.
import type { Kind } from '../machine/probing';

export type Spot = readonly [number, number];
export interface CycleView {
  looks: 'above' | 'side'; // X and Y, or along the ground and Z
  work: readonly (readonly Spot[])[]; // areas that are solid
  holes?: readonly { at: Spot; radius: number }[];
  way: readonly Spot[]; // from where the probe begins to where it ends
  touches: readonly Spot[]; // in their order
  found: readonly Spot[]; // what becomes zero
}
type Values = Readonly<Record<string, number>>;

const signOf = (side: string, axis: string): number => (side.startsWith(axis) ? (side.endsWith('-') ? -1 : 1) : 0);
const box = (left: number, bottom: number, right: number, top: number): Spot[] => [[left, bottom], [right, bottom], [right, top], [left, top]];

// Down onto a flat top, and up again.
function surface(clearance: number): CycleView {
  const size = clearance * 2;
  return { looks: 'side', work: [box(-size, -size, size, 0)], way: [[0, clearance * 1.6], [0, 0], [0, clearance]], touches: [[0, 0]], found: [[0, 0]] };
}

function edge(side: string, { clearance = 5, reach = 25 }: Values): CycleView {
  const [x, y] = [signOf(side, 'x'), signOf(side, 'y')];
  const size = reach * 0.8;
  const work = x !== 0 ? box(0, -size, x * size * 1.4, size) : box(-size, 0, size, y * size * 1.4);
  const start: Spot = [-x * reach * 0.6 || 0, -y * reach * 0.6 || 0];
  return { looks: 'above', work: [work], way: [start, [0, 0], [-x * clearance || 0, -y * clearance || 0]], touches: [[0, 0]], found: [[0, 0]] };
}

function corner(side: string, values: Values): CycleView[] {
  const { inside = 10, reach = 25, clearance = 5, depth = 3, ball = 0 } = values;
  const x = side.endsWith('left') ? 1 : -1; // the way into the work
  const y = side.startsWith('front') ? 1 : -1;
  const first: Spot = [x * inside, y * inside];
  const off = clearance + ball / 2;
  const second: Spot = [-x * off + x * (inside + off), y * inside];
  const size = Math.max(inside * 2.4, reach * 0.9);
  const above: CycleView = {
    looks: 'above',
    work: [box(0, 0, x * size, y * size)],
    way: [first, [first[0] - x * reach, first[1]], [0, first[1]], [-x * off, first[1]], second, [second[0], second[1] - y * reach], [second[0], 0], [second[0], -y * off], [0, 0]],
    touches: [first, [0, first[1]], [second[0], 0]],
    found: [[0, 0]],
  };
  const out = first[0] - x * reach;
  const beside: CycleView = {
    looks: 'side',
    work: [box(0, -Math.max(depth * 3, 10), x * size, 0)],
    way: [[first[0], clearance * 1.6], [first[0], 0], [first[0], clearance], [out, clearance], [out, -depth], [0, -depth], [-x * off, -depth], [-x * off, clearance]],
    touches: [[first[0], 0], [0, -depth]],
    found: [[0, 0]],
  };
  return [above, beside];
}

function bore({ reach = 25, back = 1 }: Values): CycleView {
  const radius = reach * 0.7;
  const size = radius * 1.5;
  const start: Spot = [radius * 0.2, radius * 0.25];
  const half = Math.sqrt(radius ** 2 - start[1] ** 2);
  return {
    looks: 'above',
    work: [box(-size, -size, size, size)],
    holes: [{ at: [0, 0], radius }],
    way: [start, [-half, start[1]], [-half + back, start[1]], [half, start[1]], [0, start[1]], [0, -radius], [0, -radius + back], [0, radius], [0, 0]],
    touches: [[-half, start[1]], [half, start[1]], [0, -radius], [0, radius]],
    found: [[0, 0]],
  };
}

// Two bores: each as one alone, and what is found lies between.
function bores(values: Values): CycleView {
  const { x = 0, y = 0, second_x = 50, second_y = 0 } = values;
  const apart = Math.max(Math.hypot(second_x - x, second_y - y), 1e-3);
  const radius = Math.min(values.reach ?? 25, apart * 0.6) * 0.4;
  const one = bore({ ...values, reach: radius / 0.7, back: radius * 0.2 });
  const moved = (spots: readonly Spot[], dx: number, dy: number): Spot[] => spots.map(([a, b]) => [a + dx, b + dy]);
  const rim = radius * 1.6;
  const second: Spot = [second_x, second_y];
  return {
    looks: 'above',
    work: [box(Math.min(x, second_x) - rim, Math.min(y, second_y) - rim, Math.max(x, second_x) + rim, Math.max(y, second_y) + rim)],
    holes: [{ at: [x, y], radius }, { at: second, radius }],
    way: [...moved(one.way, x, y), second, ...moved(one.way.slice(1), second_x, second_y)],
    touches: [...moved(one.touches, x, y), ...moved(one.touches, second_x, second_y)],
    found: [],
  };
}

function boss({ size_x = 20, size_y = 20, clearance = 5, depth = 3, ball = 0 }: Values): CycleView[] {
  const [x, y] = [size_x / 2, size_y / 2];
  const [outX, outY] = [x + clearance + ball / 2, y + clearance + ball / 2];
  const above: CycleView = {
    looks: 'above',
    work: [box(-x, -y, x, y)],
    way: [[0, 0], [-outX, 0], [-x, 0], [-x - clearance, 0], [outX, 0], [x, 0], [x + clearance, 0], [0, 0], [0, -outY], [0, -y], [0, -y - clearance], [0, outY], [0, y], [0, y + clearance], [0, 0]],
    touches: [[0, 0], [-x, 0], [x, 0], [0, -y], [0, y]],
    found: [[0, 0]],
  };
  const beside: CycleView = {
    looks: 'side',
    work: [box(-x, -Math.max(depth * 3, 10), x, 0)],
    way: [[0, clearance * 1.6], [0, 0], [0, clearance], [-outX, clearance], [-outX, -depth], [-x, -depth], [-x - clearance, -depth], [-x - clearance, clearance], [0, clearance]],
    touches: [[0, 0], [-x, -depth]],
    found: [],
  };
  return [above, beside];
}

function tool({ reach = 25 }: Values): CycleView {
  const size = reach * 0.3;
  return {
    looks: 'side',
    work: [box(-size, -reach, size, 0)],
    way: [[-reach, reach * 0.3], [-reach, reach], [0, reach], [0, 0], [0, reach]],
    touches: [[0, 0]],
    found: [],
  };
}

function angle(side: string, { along = 20, clearance = 5 }: Values): CycleView {
  const [x, y] = [signOf(side, 'x'), signOf(side, 'y')];
  const lean = 0.08; // what may be found
  const size = along * 0.7;
  const at = (t: number): Spot => (x !== 0 ? [x * t * lean * 2, t] : [t, y * t * lean * 2]);
  const from = (spot: Spot): Spot => [spot[0] - x * clearance, spot[1] - y * clearance];
  const [a, b] = [at(0), at(along)];
  const [low, high] = [at(-size * 0.5), at(along + size * 0.5)];
  const deep: Spot = [x * size * 1.4, y * size * 1.4];
  return {
    looks: 'above',
    work: [[low, high, [high[0] + deep[0], high[1] + deep[1]], [low[0] + deep[0], low[1] + deep[1]]]],
    way: [from(a), a, from(a), from(b), b, from(b)],
    touches: [a, b],
    found: [],
  };
}

function map(values: Values): CycleView {
  const { x = 0, y = 0, size_x = 20, size_y = 20, columns = 5, rows = 5 } = values;
  const touches: Spot[] = [];
  for (let row = 0; row < rows; ++row) {
    for (let i = 0; i < columns; ++i) {
      const column = row % 2 === 0 ? i : columns - 1 - i;
      touches.push([x + (size_x * column) / (columns - 1), y + (size_y * row) / (rows - 1)]);
    }
  }
  const rim = Math.max(size_x, size_y) * 0.12;
  return { looks: 'above', work: [box(x - rim, y - rim, x + size_x + rim, y + size_y + rim)], way: touches, touches, found: [] };
}

export function viewsOf(kind: Kind, side: string, values: Values): CycleView[] {
  switch (kind) {
    case 'surface': return [surface(values.clearance ?? 5)];
    case 'edge': return [edge(side, values)];
    case 'corner': return corner(side, values);
    case 'bore': return [bore(values)];
    case 'boss': return boss(values);
    case 'tool': return [tool(values)];
    case 'angle': return [angle(side, values)];
    case 'bores': return [bores(values)];
    case 'map': return [map(values)];
  }
}
