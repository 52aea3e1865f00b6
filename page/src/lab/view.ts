// What the lab shows, as it stands in the address behind "?": a link reproduces the view. Values that are as usual are left
// out, so a link is short; values that make no sense are taken as usual, and named (refusedIn).
import { wiringField } from './board/port';
import { axesField, tripleField } from './board/table';
import { driveNames, type DriveName, methodNames, ruleNames, type Method, type Move, type Rule } from './core';
import { type Field, type NumericField, range } from './field';

function choice<T extends string>(values: readonly T[], usual: T): Field<T> {
  return { usual, read: (text) => values.find((one) => one === text), write: (value) => value, expects: values.join(', ') };
}
function whole(from: number, to: number, usual: number): NumericField {
  const read = (text: string): number | undefined => {
    const value = Number(text);
    return Number.isInteger(value) && value >= from && value <= to ? value : undefined;
  };
  return { usual, read: (text) => (text === '' ? undefined : read(text)), write: String, expects: range(from, to), from, to, whole: true };
}
function real(from: number, to: number, usual: number): NumericField {
  const read = (text: string): number | undefined => {
    const value = Number(text);
    return text !== '' && Number.isFinite(value) && value >= from && value <= to ? value : undefined;
  };
  return { usual, read, write: (value) => String(Number(value.toPrecision(8))), expects: range(from, to), from, to, whole: false };
}
function pair(limit: number, usual: [number, number]): Field<[number, number]> {
  const one = whole(-limit, limit, 0);
  return {
    usual,
    read: (text) => {
      const [x, y, ...more] = text.split(',').map(one.read);
      return x !== undefined && y !== undefined && more.length === 0 ? [x, y] : undefined;
    },
    write: (value) => value.join(','),
    expects: `x,y: ${range(-limit, limit)}`,
  };
}
// The ends of the motors of a line, two to eight.
function ends(limit: number, usual: readonly number[]): Field<readonly number[]> {
  const one = whole(-limit, limit, 0);
  return {
    usual,
    read: (text) => {
      const all = text.split(',').map(one.read);
      if (all.length < 2 || all.length > mostMotors) return undefined;
      return all.every((value) => value !== undefined) ? (all as number[]) : undefined;
    },
    write: (value) => value.join(','),
    expects: `x,y[,z…]: ${range(-limit, limit)}`,
  };
}
function flag(usual: boolean): Field<boolean> {
  return { usual, read: (text) => (text === '1' ? true : text === '0' ? false : undefined), write: (v) => (v ? '1' : '0'), expects: '0, 1' };
}

export const parts = ['steps', 'ramps', 'torque', 'loop', 'board', 'driver'] as const;
export type Part = (typeof parts)[number];

// A method with its variant, as one word.
export const methodCodes = [...methodNames, 'dda-half'] as const;
export type MethodCode = (typeof methodCodes)[number];
export const methodOf = (code: MethodCode): Method =>
  code === 'dda-half' ? { name: 'dda', half_loaded: true } : { name: code, half_loaded: false };
export const codeOf = (method: Method): MethodCode => (method.half_loaded ? 'dda-half' : method.name);
export const methodsFor = (shape: 'line' | 'arc', motors = 2): MethodCode[] => {
  if (shape === 'arc') return ['midpoint', 'point-comparison', 'dda', 'dda-half'];
  if (motors > 2) return ['master-slave', 'lean', 'dda', 'dda-half', 'listing:rounding', 'listing:shared-variable'];
  return [
    'master-slave', 'lean', 'slope-recalculated', 'slope-blocks', 'point-comparison', 'dda', 'dda-half',
    'listing:rounding', 'listing:shared-variable', 'listing:slope-blocks', 'listing:projection',
  ];
};
// What a faulty listing was meant to be.
export const rightOf = (code: MethodCode): MethodCode | undefined =>
  code === 'listing:rounding' || code === 'listing:shared-variable' ? 'lean'
    : code === 'listing:slope-blocks' ? 'slope-blocks'
    : code === 'listing:projection' ? 'point-comparison'
    : undefined;

export const axisNames = ['x', 'y', 'z', 'a', 'b', 'c', 'u', 'v'] as const;
export type AxisName = (typeof axisNames)[number];
export const mostMotors = axisNames.length;

export const rotors = ['4', '24', '48', '200'] as const;
export const farthest = 200; // steps, of a drawn move along an axis
export const wholeMove = 99_999; // as a beat: all pulses have come

export const fields = {
  part: choice(parts, 'steps'),
  shape: choice(['line', 'arc'], 'line'),
  to: ends(farthest, [10, 4]),
  across: choice<AxisName>(axisNames, 'x'), // the axes that the grid shows
  up: choice<AxisName>(axisNames, 'y'),
  radius: whole(1, farthest, 8),
  end: pair(farthest, [0, 8]),
  cw: flag(false),
  a: choice(methodCodes, 'lean'),
  b: choice([...methodCodes, 'none'], 'none'),
  beat: whole(0, wholeMove, wholeMove),
  rule: choice<Rule>(ruleNames, 'beats'),
  drive: choice<DriveName>(driveNames, 'two-on'),
  rotor: choice(rotors, '4'),
  // ramps
  clock: real(1000, 2e8, 250_000),
  turn: whole(4, 100_000, 400),
  accel: real(0.1, 1e6, 50),
  steps: whole(1, 4000, 600),
  rate: real(0, 1e6, 900),
  start: real(0, 1e6, 0),
  jerk: real(0, 1e9, 500),
  table: whole(0, 65_535, 0),
  move: flag(true),
  exact: flag(true),
  recursive: flag(true),
  tabled: flag(true),
  curved: flag(false),
  // the motor of torque and loop
  hold: real(0.001, 100, 0.45),
  amps: real(0.01, 50, 1.7),
  ohms: real(0.01, 500, 1.5),
  mh: real(0.01, 500, 2.8),
  gcm2: real(0.1, 1e5, 68),
  volts: real(1, 400, 24),
  resistive: flag(false),
  loadgcm2: real(0, 1e6, 68),
  friction: real(0, 100, 0.1),
  margin: real(0.05, 1, 0.7),
  wants: real(0, 1e6, 8000), // rad/s²
  // loop
  of: choice(['speed', 'position'], 'speed'),
  jump: real(0.1, 1000, 30),
  kp: real(0, 1e5, 0.02),
  ki: real(0, 1e7, 2),
  kd: real(0, 1e4, 0),
  ikp: real(0, 1e3, 0.02),
  iki: real(0, 1e5, 2),
  drag: real(0, 100, 0.01), // friction, of the loop's motor
  load: real(0, 100, 0.1),
  loadat: real(0, 1, 0.05),
  time: real(0.01, 0.5, 0.1),
  // the first board
  lpt: wiringField,
  mode: choice(['waiting', 'automatic', 'manual'], 'waiting'),
  hz: real(0.5, 2000, 20),
  axes: axesField(1),
  down: axesField(0),
  run: flag(false),
  unit: choice(['mm', 'inch'], 'mm'),
  perunit: tripleField(0.01, 1e6, [50, 50, 50]),
  lengths: tripleField(0.01, 1e5, [110, 110, 60]),
  origin: tripleField(-1e5, 1e5, [10, 10, 50]),
  flip: axesField(4),
  zclear: real(-1e5, 1e5, 2),
  zwork: real(-1e5, 1e5, -3),
  // the stage that switches its windings
  dvolts: real(1, 400, 13.8),
  raised: real(1, 400, 36),
  series: real(0, 1e4, 22.2),
  ripple: real(0.01, 0.5, 0.1),
  drate: real(1, 20_000, 600),
  damps: real(0.01, 50, 1),
  dohms: real(0.01, 500, 12.8),
  dmh: real(0.01, 500, 10),
  dhold: real(0.001, 100, 0.5),
  dsat: real(0, 10, 1),
  gain: real(1, 1e5, 750),
  logic: real(1, 50, 5),
  vbe: real(0, 5, 1.4),
  reserve: real(0, 5, 0.3),
  base: real(1, 1e6, 470),
} as const;

type Values<T> = { [K in keyof T]: T[K] extends Field<infer V> ? V : never };
export type LabView = Values<typeof fields>;
type Name = keyof LabView;
const names = Object.keys(fields) as Name[];

export function readView(query: URLSearchParams): LabView {
  const view: Partial<Record<Name, unknown>> = {};
  for (const name of names) {
    const field = fields[name] as Field<unknown>;
    const text = query.get(name);
    view[name] = (text === null ? undefined : field.read(text)) ?? field.usual;
  }
  // A faulty listing is shown beside the right method, unless the link says what to show.
  const read = view as LabView;
  const right = query.has('b') ? undefined : rightOf(read.a);
  return sound(right ? { ...read, b: right } : read);
}

export interface RefusedValue {
  name: string;
  text: string;
  expects: string;
}
// The values of a link that make no sense, e.g. to=201,1.
export function refusedIn(query: URLSearchParams): RefusedValue[] {
  const refused: RefusedValue[] = [];
  for (const name of names) {
    const text = query.get(name);
    const field = fields[name] as Field<unknown>;
    if (text !== null && field.read(text) === undefined) refused.push({ name, text, expects: field.expects });
  }
  return refused;
}

export function writeView(view: LabView): URLSearchParams {
  const query = new URLSearchParams();
  for (const name of names) {
    const field = fields[name] as Field<unknown>;
    const text = field.write(view[name]);
    if (text !== field.write(field.usual)) query.set(name, text);
  }
  return query;
}

// What belongs together fits together: the methods take the shape, and the end of an arc is on its circle.
export function sound(view: LabView): LabView {
  const takes = methodsFor(view.shape, view.to.length);
  const a = takes.includes(view.a) ? view.a : (takes[view.shape === 'arc' ? 0 : 1] ?? 'dda');
  const b = view.b !== 'none' && takes.includes(view.b) ? view.b : 'none';
  const to = view.to.every((value) => value === 0) ? [1, ...view.to.slice(1)] : view.to;
  const motors = view.shape === 'arc' ? 2 : to.length;
  const shown = (name: AxisName): boolean => axisNames.indexOf(name) < motors;
  const across = shown(view.across) ? view.across : 'x';
  const up = shown(view.up) && view.up !== across ? view.up : across === 'y' ? 'x' : 'y';
  return { ...view, a, b, to, across, up, end: onCircle(view.radius, view.end) };
}

// The place in whole steps beside the circle that is nearest in angle. Its distance from the circle is below a step.
export function onCircle(radius: number, [x, y]: readonly [number, number]): [number, number] {
  const far = Math.hypot(x, y);
  if (far === 0) return [radius, 0];
  if (Math.abs(far - radius) < 0.75 && Number.isInteger(x) && Number.isInteger(y)) return [x, y];
  const zero = (value: number): number => (value === 0 ? 0 : value); // never −0
  return [zero(Math.round((x / far) * radius)), zero(Math.round((y / far) * radius))];
}

export function moveOf(view: LabView): Move {
  if (view.shape === 'line') {
    const line = { from: { x: 0, y: 0 }, to: { x: view.to[0] ?? 0, y: view.to[1] ?? 0 } };
    return view.to.length > 2 ? { ...line, ends: view.to } : line;
  }
  return {
    from: { x: view.radius, y: 0 },
    to: { x: view.end[0], y: view.end[1] },
    arc: { centre: { x: 0, y: 0 }, clockwise: view.cw },
  };
}
