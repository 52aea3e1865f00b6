// Where on the path the machine is: the motion of the executed line that is nearest to the tool.
import { placeAt, type PathPoints, type Vector } from './path_data';

export interface Done {
  chunk: number;
  share: number; // of the chunk's motions
}

export function doneOf(all: readonly PathPoints[], line: number, tool: Vector): Done | null {
  let best: Done | null = null;
  let nearest = Infinity;
  let before: Done | null = null; // the last motion of an earlier line, for lines that a coarse level lacks
  let beforeLine = 0;
  const end: Vector = [0, 0, 0];
  const start: Vector = [0, 0, 0];
  for (const points of all) {
    for (let i = 1; i < points.count; ++i) {
      const at = points.lines[i]!;
      if (at === line) {
        placeAt(points, i, end);
        placeAt(points, i - 1, start);
        const away = distance(tool, start, end);
        if (away < nearest) {
          nearest = away;
          best = { chunk: points.chunk, share: (i - 1) / Math.max(1, points.count - 1) };
        }
      } else if (at < line && at >= beforeLine) {
        beforeLine = at;
        before = { chunk: points.chunk, share: i / Math.max(1, points.count - 1) };
      }
    }
  }
  return best ?? before;
}

// From a place to the segment from a to b.
export function distance(place: Vector, a: Vector, b: Vector): number {
  let along = 0;
  let square = 0;
  for (let k = 0; k < 3; ++k) {
    along += (place[k]! - a[k]!) * (b[k]! - a[k]!);
    square += (b[k]! - a[k]!) ** 2;
  }
  const share = square > 0 ? Math.min(1, Math.max(0, along / square)) : 0;
  let away = 0;
  for (let k = 0; k < 3; ++k) away += (a[k]! + share * (b[k]! - a[k]!) - place[k]!) ** 2;
  return Math.sqrt(away);
}
