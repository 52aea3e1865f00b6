// Single pulses of the motors, as the daemon has sent them to the board: a window of time, and what is drawn of it.
import { ask } from './api';

export interface PulseWindow {
  begin: number; // s of the board's clock, as all times here
  end: number;
  oldest: number;
  newest: number;
  motors: number;
  counts: readonly number[]; // the motors' steps at `begin`
  times: Float64Array; // s after `begin`
  stepped: Uint8Array; // bit m: motor m steps
  down: Uint8Array; // bit m: downwards
}

const header = 80; // bytes
export function readPulses(bytes: ArrayBuffer): PulseWindow {
  const view = new DataView(bytes);
  const count = bytes.byteLength >= header ? view.getUint32(72, true) : 0;
  if (bytes.byteLength !== header + 8 * count) throw new Error('these are no pulses');
  const tick = view.getFloat64(32, true);
  const times = new Float64Array(count);
  const stepped = new Uint8Array(count);
  const down = new Uint8Array(count);
  for (let i = 0; i < count; ++i) {
    const at = header + 8 * i;
    times[i] = view.getUint32(at, true) * tick;
    stepped[i] = view.getUint8(at + 4);
    down[i] = view.getUint8(at + 5);
  }
  const [begin, end, oldest, newest] = [0, 8, 16, 24].map((at) => view.getFloat64(at, true)) as [number, number, number, number];
  const counts = Array.from({ length: 8 }, (_, motor) => view.getInt32(40 + 4 * motor, true));
  return { begin, end, oldest, newest, motors: view.getUint32(76, true), counts, times, stepped, down };
}

// Without `from`: the newest.
export async function askPulses(from?: number, to?: number): Promise<PulseWindow> {
  const query = from === undefined || to === undefined ? '' : `?from=${from.toFixed(9)}&to=${to.toFixed(9)}`;
  return readPulses(await (await ask('GET', `/pulses${query}`)).arrayBuffer());
}

export interface MotorPulses {
  at: number[]; // s of the board's clock
  up: boolean[];
  counts: number[]; // after each pulse
  before: number; // the count before the first
}
export function pulsesOf(window: PulseWindow, motor: number): MotorPulses {
  const found: MotorPulses = { at: [], up: [], counts: [], before: window.counts[motor] ?? 0 };
  let count = found.before;
  for (let i = 0; i < window.times.length; ++i) {
    if (((window.stepped[i]! >> motor) & 1) === 0) continue;
    const up = ((window.down[i]! >> motor) & 1) === 0;
    count += up ? 1 : -1;
    found.at.push(window.begin + window.times[i]!);
    found.up.push(up);
    found.counts.push(count);
  }
  return found;
}

// The currents of the two windings, as a share of the highest: a driver goes a turn of the field in four full steps.
export function windingsAt(count: number, microsteps: number): [number, number] {
  const angle = ((count / microsteps) * Math.PI) / 2;
  return [Math.cos(angle), Math.sin(angle)];
}

// How many of the ascending times are at or before `at`.
export function upTo(times: readonly number[], at: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= at) low = middle + 1;
    else high = middle;
  }
  return low;
}

export interface Span {
  from: number;
  to: number;
}
export const shortest = 2e-6; // s
export const longest = 20;
export function zoomed(span: Span, factor: number, about: number): Span {
  const wide = Math.min(longest, Math.max(shortest, (span.to - span.from) * factor));
  const share = (about - span.from) / (span.to - span.from);
  return { from: about - share * wide, to: about + (1 - share) * wide };
}

// "12.5 ms": three digits that count, and a unit that suits.
export function timeWords(seconds: number): string {
  const size = Math.abs(seconds);
  const [factor, unit] = size < 1e-3 ? [1e6, 'µs'] : size < 1 ? [1e3, 'ms'] : [1, 's'];
  return `${Number((seconds * factor).toPrecision(4))} ${unit}`;
}
