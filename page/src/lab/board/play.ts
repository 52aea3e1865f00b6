// The first board while it is shown: time passes for it as on the screen, and what is pressed and written reaches it.
import { useEffect, useRef, useState } from 'preact/hooks';
import { type BoardAnswer, isFailed, type LabCore } from '../core';
import { boardLines, type Registers, restingRegisters, withBoardLines, withLine, type Wire, type Wiring } from './port';

export const keyNames = ['1', '2', '3', '4', '5', '6', '7', '8', '9', '*', '0', '#'] as const;
export type KeyName = (typeof keyNames)[number];

const longestPicture = 0.05; // s; a page that was hidden does not catch up
const press = 60_000; // µs
const directionLines = ['directionX', 'directionY', 'directionZ'] as const;
const clockLines = ['clockX', 'clockY', 'clockZ'] as const;

export interface Clock {
  axes: number; // a bit for each
  hertz: number;
  pulses: number; // −1: without an end
}

export interface Played {
  answer: BoardAnswer;
  registers: Registers; // without the status
  counted: readonly number[]; // steps of each motor, as the program has commanded them
}

// What the page does with the board.
export class Bench {
  keys = 0;
  button = false;
  isReset = false;
  registers: Registers;
  answer: BoardAnswer;
  counted = [0, 0, 0];
  readonly #core: LabCore;
  #wiring: Wiring;
  #clockAxes = 0;
  #down = 0; // what the program wants of each direction, also where the line has no pin

  constructor(core: LabCore, wiring: Wiring) {
    this.#core = core;
    this.#wiring = wiring;
    this.registers = restingRegisters(wiring);
    core.boardRestart();
    this.answer = this.run(1000);
  }

  // The table of pins has changed: all lines rest on their new pins.
  set wiring(wiring: Wiring) {
    if (wiring === this.#wiring) return;
    this.clock({ axes: 0, hertz: 1, pulses: 0 });
    this.#wiring = wiring;
    this.registers = restingRegisters(wiring);
  }

  run(microseconds: number): BoardAnswer {
    const before = boardLines(this.#wiring, this.registers);
    const answer = this.#core.board(before, this.keys, this.button, microseconds);
    if (isFailed(answer)) return this.answer;
    if (answer.lines !== before) this.registers = withBoardLines(this.#wiring, this.registers, answer.lines);
    const pulses = answer.pulses - (this.answer?.pulses ?? 0);
    if (pulses > 0) this.#count(pulses);
    this.answer = answer;
    return answer;
  }

  #count(pulses: number): void {
    this.counted = this.counted.map((count, axis) => {
      if (((this.#clockAxes >> axis) & 1) === 0) return count;
      return count + (this.isDown(axis) ? -pulses : pulses);
    });
  }

  // The program's direction of an axis: down is 1 on its line.
  isDown(axis: number): boolean {
    const line = directionLines[axis] ?? 'directionX';
    if (this.#wiring[line].pin === 0) return ((this.#down >> axis) & 1) === 1;
    const level = (boardLines(this.#wiring, this.registers) >> (3 + axis)) & 1;
    return (level ^ (this.#wiring[line].inverted ? 1 : 0)) === 1;
  }
  turn(axis: number, down: boolean): void {
    this.#down = down ? this.#down | (1 << axis) : this.#down & ~(1 << axis);
    this.registers = withLine(this.#wiring, this.registers, directionLines[axis] ?? 'directionX', down);
  }

  // The direction is stable before the first edge: the clock begins half a period later.
  clock({ axes, hertz, pulses }: Clock): void {
    this.run(1000);
    const those = (test: (wire: Wire) => boolean): number =>
      clockLines.reduce((set, line, i) => set | (test(this.#wiring[line]) ? 1 << i : 0), 0);
    this.#core.boardClock(axes, 5e5 / hertz, pulses, those((wire) => wire.inverted), those((wire) => wire.pin !== 0));
    if (axes !== 0) this.#clockAxes = axes;
    this.run(1000);
  }

  reset(pressed: boolean): void {
    this.isReset = pressed;
    this.#core.boardReset(pressed);
    this.run(1000);
  }

  // A key as a person presses it, at once.
  type(name: KeyName): void {
    this.keys = 1 << keyNames.indexOf(name);
    this.run(press);
    this.keys = 0;
    this.run(press);
  }

  get played(): Played {
    return { answer: this.answer, registers: this.registers, counted: this.counted };
  }
}

// The bench, and what it shows now. `begin` is called once.
export function useBench(core: LabCore, wiring: Wiring, begin: (bench: Bench) => void): [Bench, Played] {
  const held = useRef<Bench | undefined>(undefined);
  held.current ??= new Bench(core, wiring);
  const bench = held.current;
  const [played, setPlayed] = useState(bench.played);
  useEffect(() => {
    begin(bench);
    let last = performance.now();
    let shown = '';
    let request = requestAnimationFrame(function picture(now) {
      bench.run(Math.min(longestPicture, Math.max(0, now - last) / 1000) * 1e6);
      last = now;
      const text = JSON.stringify(bench.played);
      if (text !== shown) setPlayed(bench.played);
      shown = text;
      request = requestAnimationFrame(picture);
    });
    return () => cancelAnimationFrame(request);
  }, [bench]);
  useEffect(() => {
    bench.wiring = wiring;
  }, [bench, wiring]);
  return [bench, played];
}
