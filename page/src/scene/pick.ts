// Which motion lies under the pointer.
import { axesOf, dot, type View } from './camera';
import { flagRapid, placeAt, type PathPoints, type Spot } from './path_data';

// `x`, `y`: CSS pixels from the middle, y down. Null: nothing within `reach` pixels. A cut wins over a rapid.
export function pick(all: Iterable<PathPoints>, view: View, x: number, y: number, reach: number, rapids: boolean): Spot | null {
  const { right, up } = axesOf(view);
  let best: Spot | null = null;
  let nearest = reach;
  for (const points of all) {
    // The projection of origin + step * number is linear in the numbers.
    const { origin, step, places } = points;
    const away = [origin[0] - view.centre[0], origin[1] - view.centre[1], origin[2] - view.centre[2]] as const;
    const firstX = dot([...away], right) / view.scale - x;
    const firstY = -dot([...away], up) / view.scale - y;
    const kx = [0, 1, 2].map((k) => (right[k]! * step[k]!) / view.scale);
    const ky = [0, 1, 2].map((k) => (-up[k]! * step[k]!) / view.scale);
    const [kx0, kx1, kx2] = [kx[0]!, kx[1]!, kx[2]!];
    const [ky0, ky1, ky2] = [ky[0]!, ky[1]!, ky[2]!];
    let [ax, ay] = [0, 0];
    for (let i = 0; i < points.count; ++i) {
      const p0 = places[i * 4]!;
      const p1 = places[i * 4 + 1]!;
      const p2 = places[i * 4 + 2]!;
      const bx = firstX + kx0 * p0 + kx1 * p1 + kx2 * p2;
      const by = firstY + ky0 * p0 + ky1 * p1 + ky2 * p2;
      if (i > 0) {
        const isRapid = (places[i * 4 + 3]! & flagRapid) !== 0;
        const distance = distanceToSegment(ax, ay, bx, by) + (isRapid ? 3 : 0);
        if (distance < nearest && (rapids || !isRapid)) {
          nearest = distance;
          best = { chunk: points.chunk, index: i, line: points.lines[i]!, place: placeAt(points, i) };
        }
      }
      ax = bx;
      ay = by;
    }
  }
  return best;
}

// From (0, 0) to the segment from a to b.
export function distanceToSegment(ax: number, ay: number, bx: number, by: number): number {
  const [dx, dy] = [bx - ax, by - ay];
  const square = dx * dx + dy * dy;
  const share = square > 0 ? Math.min(1, Math.max(0, -(ax * dx + ay * dy) / square)) : 0;
  return Math.hypot(ax + share * dx, ay + share * dy);
}
