// The program's own interpolators, ramps and motors, compiled to WebAssembly (src/lab in C++). Nothing is computed twice:
// what the lab draws are the answers of this module, and a test compares them with what `passo` prints.

import { startModule } from '../core/wasm';

export interface Failed {
  error: string;
}
export type Answer<T> = T | Failed;
export const isFailed = (answer: object): answer is Failed => 'error' in answer;

// --- moves ---

export const ruleNames = ['beats', 'roots', 'exact'] as const;
export type Rule = (typeof ruleNames)[number];
export const methodNames = [
  'master-slave', 'lean', 'dda', 'slope-recalculated', 'slope-blocks', 'point-comparison', 'midpoint',
  'listing:rounding', 'listing:shared-variable', 'listing:slope-blocks', 'listing:projection',
] as const;
export type MethodName = (typeof methodNames)[number];

export interface Method {
  name: MethodName;
  half_loaded: boolean;
}
export interface Place {
  x: number;
  y: number;
}
export interface Move {
  from: Place;
  to: Place;
  ends?: readonly number[]; // of a line of more than two axes: the ends of all of them
  arc?: { centre: Place; clockwise: boolean };
}

export interface Figures {
  name: MethodName;
  half_loaded: boolean;
  title: string;
  pulses: number;
  together: number;
  idle: number;
  largest: number; // steps
  mean: number;
  lag: Record<Rule, number>;
  ratio: Record<Rule, number>;
}
// Lists have an entry for each pulse; deviations are in steps.
export interface Interpolation extends Figures {
  length: number;
  ideal: { x: number[]; y: number[] };
  steps: number[];
  directions: number[];
  x: number[];
  y: number[];
  foot_x: number[];
  foot_y: number[];
  deviation: number[];
  clock: Record<Rule, number[]>;
  judge: Record<string, string[]>;
  decisions: Record<string, number[]>;
  end: Record<string, string[]>;
  places: number[][]; // a list for each axis
  feet: number[][];
  fault?: Fault;
}
// What a faulty listing gets wrong. Pulses are counted from 1; `first` may be the one that is missing at the end.
export interface Fault {
  right: string;
  first: number;
  wrong: number[];
  end: number[];
  ends_right: boolean;
}

// --- motors ---

export const driveNames = ['two-on', 'wave', 'half-step', 'micro-4', 'micro-8', 'micro-16'] as const;
export type DriveName = (typeof driveNames)[number];
const driveNumbers: Record<DriveName, number> = {
  'two-on': 0, wave: 1, 'half-step': 2, 'micro-4': 5, 'micro-8': 9, 'micro-16': 17,
};
export interface Windings {
  first: number;
  steps_per_full_step: number;
  pattern: number[]; // bit 0: F1
  phase_a: number[];
  phase_b: number[];
  degrees: number[];
}

export interface Motor {
  stepsPerTurn: number;
  rotorInertia: number; // kg·m²
  holdingTorque: number; // N·m
  current: number; // A
  resistance: number; // Ω
  inductance: number; // H
  supply: number; // V
  resistive: boolean;
  loadInertia: number; // kg·m²
  friction: number; // N·m
}
export interface Torque {
  rate_hz: number[];
  pull_out_nm: number[];
  pull_in_nm: number[];
  friction_nm: number[];
  needed_nm: number[];
  acceleration_rad_s2: number[];
  standstill_torque_nm: number;
  starting_rate_hz: number;
  fastest_rate_hz: number | null;
  accelerated_rate_hz: number | null;
}

// --- ramps ---

export const rampMethodNames = ['exact', 'recursive', 'table', 'midpoint'] as const;
export type RampMethodName = (typeof rampMethodNames)[number];
export interface RampRequest {
  method: RampMethodName;
  clock: number; // Hz
  stepsPerTurn: number;
  acceleration: number; // rad/s²
  steps: number;
  wholeMove: boolean;
  wholeTicks: boolean;
  rate: number; // steps a second; 0: no limit
  start: number;
  jerk: number; // rad/s³
  tableSize: number;
}
export interface Ramp {
  first_interval: number;
  whole_ticks: boolean;
  ticks: number[];
  error_ticks: number[];
  end_s: number[];
  ideal_time_s: number[];
  ideal_rate_hz: number[];
}

// --- loops ---

export interface Gains {
  kp: number;
  ki: number;
  kd: number;
}
export interface LoopRequest {
  of: 'speed' | 'position';
  to: number; // rad/s or rad
  period: number; // s
  gains: Gains;
  inner: { kp: number; ki: number };
  load: number; // N·m
  loadAt: number; // s
  time: number; // s
}
export interface Loop {
  wanted: number;
  time_s: number[];
  counted: number[];
  is: number[];
  asked_nm: number[];
  torque_nm: number[];
  rise_s: number | null;
  overshoot: number;
  settled_s: number | null;
  steady_error: number;
  swing: number;
}
export interface Ultimate {
  gain: number;
  period_s: number;
  p: Gains;
  pi: Gains;
  pid: Gains;
}

// --- the stage that switches a winding ---

export interface DriverRequest {
  drop: number; // V, at the transistor
  raised: number; // V
  series: number; // Ω
  ripple: number; // of the chopper, as a fraction of its current
  rate: number; // full steps a second
  gain: number;
  baseEmitter: number; // V
  logic: number; // V
  reserve: number; // of the base current, as a fraction
  base: number; // Ω
}
export interface Stage {
  final_a: number;
  tau_s: number;
  rise_s: number | null; // to 90 % of the rated current
  time_s: number[];
  current_a: number[];
  most_a: number;
  winding_w: number;
  series_w: number;
  transistor_w: number;
  rate_hz: number[];
  pull_out_nm: number[];
}
export const stageNames = ['plain', 'series', 'chopper'] as const;
export type StageName = (typeof stageNames)[number];
export interface Driver extends Record<StageName, Stage> {
  base: {
    needed_a: number;
    wanted_a: number;
    largest_ohm: number;
    given_a: number;
    overdrive: number;
    heat_w: number;
    warmer_k: number;
  };
}

// --- the first board ---

export interface BoardAnswer {
  lines: number; // clock X, Y, Z, direction X, Y, Z, tool
  clock_runs: boolean;
  pulses: number; // that the clock has made
  patterns: number[]; // of each motor, bit 0: F1
  rotors: number[]; // steps
  relay: boolean;
  relay_led: boolean;
  mode: 'reset' | 'waiting' | 'automatic' | 'manual';
  leds: number[]; // RB0, RD1, RD2, RD3
}

// --- the module ---

type Question = (...values: number[]) => number;

export class LabCore {
  readonly #exports: WebAssembly.Exports;
  readonly #memory: WebAssembly.Memory;

  private constructor(exports: WebAssembly.Exports) {
    this.#exports = exports;
    this.#memory = exports.memory as WebAssembly.Memory;
  }

  static async load(bytes: BufferSource): Promise<LabCore> {
    return new LabCore(await startModule(bytes));
  }

  #ask<T>(question: string, ...values: number[]): Answer<T> {
    const length = (this.#exports[question] as Question)(...values);
    const at = (this.#exports.lab_answer as () => number)();
    return JSON.parse(new TextDecoder().decode(new Uint8Array(this.#memory.buffer, at, length))) as Answer<T>;
  }

  interpolation(method: Method, move: Move): Answer<Interpolation> {
    const number = methodNames.indexOf(method.name);
    if (move.ends) return this.#ask('lab_line', number, method.half_loaded ? 1 : 0, ...endsOf(move.ends));
    return this.#ask('lab_interpolation', number, method.half_loaded ? 1 : 0, ...numbersOf(move));
  }
  comparison(move: Move): Answer<{ methods: Figures[] }> {
    if (move.ends) return this.#ask('lab_line_comparison', ...endsOf(move.ends));
    return this.#ask('lab_comparison', ...numbersOf(move));
  }
  windings(drive: DriveName, stepsPerTurn: number, first: number, last: number): Answer<Windings> {
    return this.#ask('lab_windings', driveNumbers[drive], stepsPerTurn, first, last);
  }
  ramp(ask: RampRequest): Answer<Ramp> {
    return this.#ask(
      'lab_ramp', rampMethodNames.indexOf(ask.method), ask.clock, ask.stepsPerTurn, ask.acceleration, ask.steps,
      ask.wholeMove ? 1 : 0, ask.wholeTicks ? 1 : 0, ask.rate, ask.start, ask.jerk, ask.tableSize,
    );
  }
  torque(motor: Motor, margin: number, acceleration: number, rows: number): Answer<Torque> {
    this.#setMotor(motor);
    return this.#ask('lab_torque', margin, acceleration, rows);
  }
  loop(motor: Motor, ask: LoopRequest): Answer<Loop> {
    this.#setMotor(motor);
    const { kp, ki, kd } = ask.gains;
    return this.#ask(
      'lab_loop', ask.of === 'position' ? 1 : 0, ask.to, ask.period, kp, ki, kd, ask.inner.kp, ask.inner.ki, ask.load,
      ask.loadAt, ask.time,
    );
  }
  ultimate(motor: Motor, ask: LoopRequest): Answer<Ultimate> {
    this.#setMotor(motor);
    return this.#ask(
      'lab_ultimate', ask.of === 'position' ? 1 : 0, ask.to, ask.period, ask.inner.kp, ask.inner.ki,
    );
  }

  driver(motor: Motor, ask: DriverRequest): Answer<Driver> {
    this.#setMotor(motor);
    return this.#ask(
      'lab_driver', ask.drop, ask.raised, ask.series, ask.ripple, ask.rate, ask.gain, ask.baseEmitter, ask.logic, ask.reserve,
      ask.base,
    );
  }
  board(lines: number, keys: number, button: boolean, microseconds: number): Answer<BoardAnswer> {
    return this.#ask('lab_board', lines, keys, button ? 1 : 0, microseconds);
  }
  boardReset(pressed: boolean): void {
    (this.#exports.lab_board_reset as Question)(pressed ? 1 : 0);
  }
  boardRestart(): void {
    (this.#exports.lab_board_restart as Question)();
  }
  boardClock(axes: number, halfMicroseconds: number, pulses: number, idle: number, wired: number): void {
    (this.#exports.lab_board_clock as Question)(axes, halfMicroseconds, pulses, idle, wired);
  }

  #setMotor(motor: Motor): void {
    (this.#exports.lab_motor as Question)(
      motor.stepsPerTurn, motor.rotorInertia, motor.holdingTorque, motor.current, motor.resistance, motor.inductance,
      motor.supply, motor.resistive ? 1 : 0, motor.loadInertia, motor.friction,
    );
  }
}

// How many axes, and eight ends.
function endsOf(ends: readonly number[]): number[] {
  return [ends.length, ...ends, ...new Array<number>(8 - ends.length).fill(0)];
}

function numbersOf(move: Move): number[] {
  const sense = move.arc ? (move.arc.clockwise ? 2 : 1) : 0;
  const centre = move.arc?.centre ?? { x: 0, y: 0 };
  return [move.from.x, move.from.y, move.to.x, move.to.y, sense, centre.x, centre.y];
}
