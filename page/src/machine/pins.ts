// The board's pins: what is on, since when, and how it was in the last seconds. The daemon tells each change, at most 30
// times a second.
import { computed, effect, signal } from '@preact/signals';
import type { Level, Machine, PinName, Status } from './api';
import { connection, machine, status } from './connection';

export interface Pin {
  id: string; // 'limit 0', 'probe'
  kind: 'input' | 'output';
  name: PinName | 'limit';
  number: number; // of a limit switch
  axes: string[]; // whose limit it is
  onAt: Level;
}

export function pinsOf(known: Machine): Pin[] {
  const pin = (kind: Pin['kind'], name: PinName): Pin => ({ id: name, kind, name, number: 0, axes: [], onAt: known.pins[name] });
  const limits = known.pins.limits.map((onAt, number): Pin => {
    const motors = known.motors.filter((one) => one.limit === number);
    return { id: `limit ${number}`, kind: 'input', name: 'limit', number, axes: motors.map((one) => one.axis), onAt };
  });
  const inputs = (['probe', 'door', 'emergency_stop', 'hold', 'start'] as const).map((name) => pin('input', name));
  const outputs = (['spindle', 'spindle_reverse', 'mist', 'flood'] as const).map((name) => pin('output', name));
  return [...limits, ...inputs, ...outputs];
}

export function isOn(pin: Pin, now: Status): boolean {
  const { inputs, outputs } = now;
  switch (pin.name) {
    case 'limit': return inputs.limits.includes(pin.number);
    case 'probe': return inputs.probe;
    case 'door': return inputs.door;
    case 'emergency_stop': return inputs.emergency_stop;
    case 'hold': return inputs.hold;
    case 'start': return inputs.start;
    case 'spindle': return outputs.spindle !== 'off';
    case 'spindle_reverse': return outputs.spindle === 'counterclockwise';
    case 'mist': return outputs.mist;
    case 'flood': return outputs.flood;
    default: return false;
  }
}

export const levelOf = (pin: Pin, on: boolean): Level => (on ? pin.onAt : pin.onAt === 'high' ? 'low' : 'high');

export const pins = computed<Pin[]>(() => (machine.value === null ? [] : pinsOf(machine.value)));

// One look at all pins, and where the motors were.
export interface Sample {
  at: number; // ms, of this page's clock
  on: boolean[]; // in the order of `pins`
  steps: number[]; // of the motors, from machine zero
}
export const shownFor = 20_000; // ms
export const samples = signal<readonly Sample[]>([]);
// When each pin has last changed, while this page was open: ms, of the clock on the wall. By id.
export const changedAt = signal<Readonly<Record<string, number>>>({});

function stepsOf(known: Machine, now: Status): number[] {
  return known.motors.map((motor) => {
    const axis = known.axes.find((one) => one.axis === motor.axis);
    return Math.round((now.place[motor.axis] ?? 0) * (axis?.steps_per_unit ?? 0));
  });
}

// Drops what is older than what is shown, but for one look that says how it was at the left edge.
export function kept(all: readonly Sample[], next: Sample): Sample[] {
  const first = all.findIndex((one) => one.at >= next.at - shownFor);
  return [...(first < 0 ? all.slice(-1) : all.slice(Math.max(0, first - 1))), next];
}

export function followPins(): void {
  effect(() => {
    const now = status.value;
    const known = machine.value;
    if (now === null || known === null) return;
    const all = pins.value;
    const before = samples.peek().at(-1);
    const next: Sample = { at: performance.now(), on: all.map((pin) => isOn(pin, now)), steps: stepsOf(known, now) };
    if (before !== undefined && before.on.length === next.on.length) {
      const changed = all.filter((_, i) => before.on[i] !== next.on[i]);
      if (changed.length > 0) changedAt.value = { ...changedAt.peek(), ...Object.fromEntries(changed.map((pin) => [pin.id, Date.now()])) };
      const same = changed.length === 0 && before.steps.every((one, i) => one === next.steps[i]);
      if (same) return;
    }
    samples.value = kept(samples.peek(), next);
  });
  effect(() => {
    // What happened meanwhile is not known.
    if (connection.value === 'lost') samples.value = [];
  });
}
