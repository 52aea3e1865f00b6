// The chunks of a program's path, as `GET /programs/{id}/path?chunk=…` gives them: see docs/api/openapi.json.

export type Vector = [number, number, number];

export interface PathPoints {
  chunk: number;
  level: number;
  count: number;
  origin: Vector;
  step: Vector;
  // Four numbers a point: x, y, z, flags. The place is origin + step * number, mm.
  places: Uint16Array;
  lines: Uint32Array;
  // Where another tool is put in: from this point on, which of the program's tools.
  tools: readonly { from: number; tool: number }[];
}

export const flagRapid = 1;
// Bits 8 to 15 of the flags: the programmed speed.
export const speedCode = (mmAMinute: number): number => Math.min(255, Math.max(1, Math.round(16 * (Math.log2(mmAMinute / 60) + 6))));
// Bits 1 to 7: as the daemon sends them, the tool. It is noted apart, and then they are the torque that the motors need,
// if it is known: 1 + 50 times the share of what is surely there.
export const fullLoad = 50;
export function noteLoads(points: PathPoints, loads: Uint16Array): void {
  const { places, lines } = points;
  for (let i = 0; i < points.count; ++i) {
    const load = loads[lines[i]!] ?? 0; // 1 + hundredths
    const code = load === 0 ? 0 : Math.min(127, 1 + ((load - 1) >> 1));
    places[i * 4 + 3] = (places[i * 4 + 3]! & 0xff01) | (code << 1);
  }
}
const magic = 0x50534150;
const header = 40; // bytes

const bytesAPoint = 12;

// Chunks one after the other.
export function readChunks(bytes: ArrayBuffer): PathPoints[] {
  const all: PathPoints[] = [];
  for (let from = 0; from < bytes.byteLength; from += header + all.at(-1)!.count * bytesAPoint) all.push(readChunk(bytes, from));
  return all;
}

function readChunk(bytes: ArrayBuffer, from: number): PathPoints {
  const view = new DataView(bytes, from);
  if (view.byteLength < header || view.getUint32(0, true) !== magic) throw new Error('this is no chunk of a path');
  const count = view.getUint32(4, true);
  if (view.byteLength < header + count * bytesAPoint) throw new Error('this chunk of a path is cut off');
  const vector = (at: number): Vector => [view.getFloat32(at, true), view.getFloat32(at + 4, true), view.getFloat32(at + 8, true)];
  const places = new Uint16Array(bytes, from + header, count * 4);
  return {
    count,
    tools: takeTools(places, count),
    chunk: view.getUint32(8, true),
    level: view.getUint32(12, true),
    origin: vector(16),
    step: vector(28),
    places,
    lines: new Uint32Array(bytes, from + header + count * 8, count),
  };
}

// Reads the tools out of the flags, where the torque comes later.
function takeTools(places: Uint16Array, count: number): { from: number; tool: number }[] {
  const tools: { from: number; tool: number }[] = [];
  for (let i = 0; i < count; ++i) {
    const tool = (places[i * 4 + 3]! >> 1) & 127;
    if (tool !== tools.at(-1)?.tool) tools.push({ from: i, tool });
    places[i * 4 + 3] = places[i * 4 + 3]! & 0xff01;
  }
  return tools;
}

export function placeAt(points: PathPoints, i: number, into: Vector = [0, 0, 0]): Vector {
  for (let k = 0; k < 3; ++k) into[k] = points.origin[k]! + points.step[k]! * points.places[i * 4 + k]!;
  return into;
}

export function boxOf(points: PathPoints): { low: Vector; high: Vector } {
  const high = points.origin.map((low, k) => low + points.step[k]! * 65535) as Vector;
  return { low: points.origin, high };
}

export interface Spot {
  chunk: number;
  index: number; // of the point at which the motion ends
  line: number;
  place: Vector;
}

// The first motion of a line; where a coarse level has left it out, that of the nearest line.
export function spotOfLine(all: readonly PathPoints[], line: number): Spot | null {
  let best: Spot | null = null;
  let nearest = Infinity;
  for (const points of all) {
    for (let i = 1; i < points.count; ++i) {
      const away = Math.abs(points.lines[i]! - line);
      if (away >= nearest) continue;
      nearest = away;
      best = { chunk: points.chunk, index: i, line: points.lines[i]!, place: placeAt(points, i) };
      if (away === 0) return best;
    }
  }
  return best;
}
