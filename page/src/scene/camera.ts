// A camera without perspective, as of a drawing: it turns about a centre, and shows so many mm a pixel.
import type { Vector } from './path_data';

export interface View {
  centre: Vector;
  yaw: number; // radians, about Z
  pitch: number; // radians; 90 degrees looks straight down
  scale: number; // mm a CSS pixel
}

export const views = {
  top: { yaw: 0, pitch: Math.PI / 2 },
  front: { yaw: 0, pitch: 0 },
  iso: { yaw: -Math.PI / 6, pitch: Math.PI / 5.2 },
} as const;

export interface Axes {
  right: Vector;
  up: Vector;
  back: Vector; // towards the eye
}

export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export function axesOf({ yaw, pitch }: Pick<View, 'yaw' | 'pitch'>): Axes {
  const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
  return { right: [cy, sy, 0], up: [-sy * sp, cy * sp, cp], back: [sy * cp, -cy * cp, sp] };
}

const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

// From a place in mm to CSS pixels from the middle of the window, y down.
export function project(view: View, axes: Axes, place: Vector): [number, number] {
  const away = minus(place, view.centre);
  return [dot(away, axes.right) / view.scale, -dot(away, axes.up) / view.scale];
}

// Column by column, for WebGL.
export function matrixOf(view: View, width: number, height: number, depth: number): Float32Array {
  const axes = axesOf(view);
  const x = 2 / (width * view.scale);
  const y = 2 / (height * view.scale);
  const z = -1 / depth;
  const { right, up, back } = axes;
  const c = view.centre;
  return new Float32Array([
    right[0] * x, up[0] * y, back[0] * z, 0,
    right[1] * x, up[1] * y, back[1] * z, 0,
    right[2] * x, up[2] * y, back[2] * z, 0,
    -dot(c, right) * x, -dot(c, up) * y, -dot(c, back) * z, 1,
  ]); // prettier-ignore
}

export function orbit(view: View, dx: number, dy: number): View {
  const pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, view.pitch + dy * 0.008));
  return { ...view, yaw: view.yaw - dx * 0.008, pitch };
}

export function pan(view: View, dx: number, dy: number): View {
  const { right, up } = axesOf(view);
  const move = (k: 0 | 1 | 2): number => view.centre[k] - (right[k] * dx - up[k] * dy) * view.scale;
  return { ...view, centre: [move(0), move(1), move(2)] };
}

// Zooms so that the place under (x, y), CSS pixels from the middle, stays there.
export function zoom(view: View, factor: number, x: number, y: number): View {
  const scale = Math.min(100, Math.max(1e-4, view.scale * factor));
  const moved = pan(view, -x, -y);
  return pan({ ...moved, scale }, x, y);
}

export function fit(view: View, low: Vector, high: Vector, width: number, height: number): View {
  const axes = axesOf(view);
  const centre: Vector = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
  let across = 0;
  let along = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const place: Vector = [corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]];
    const away = minus(place, centre);
    across = Math.max(across, Math.abs(dot(away, axes.right)));
    along = Math.max(along, Math.abs(dot(away, axes.up)));
  }
  const scale = Math.max((2 * across) / (width * 0.86), (2 * along) / (height * 0.82), 1e-3);
  return { ...view, centre, scale };
}
