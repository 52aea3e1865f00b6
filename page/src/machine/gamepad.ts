// A gamepad jogs as keys do: while something is held, on the page "Set up", in a window that has the focus.
import { effect, signal } from '@preact/signals';
import { path } from '../core/route';
import { letGo, nameOf, press, windowHasFocus, type Direction } from './jog';

const lookEvery = 40; // ms. A timer looks, and not the screen's frames: those end where nobody sees the page.
const stickCounts = 0.6; // of its way
// Of the standard layout.
const buttons: readonly [number, Direction][] = [
  [12, { y: 1 }],
  [13, { y: -1 }],
  [14, { x: -1 }],
  [15, { x: 1 }],
  [4, { z: -1 }],
  [5, { z: 1 }],
];
const sticks: readonly [number, string, 1 | -1][] = [
  [0, 'x', 1],
  [1, 'y', -1],
  [3, 'z', -1],
];

export interface Held {
  mapping: string;
  buttons: readonly { pressed: boolean }[];
  axes: readonly number[];
}

// Nothing, if the layout is not known, or if opposite ways are held.
export function directionOf(pad: Held): Direction {
  const sum: Record<string, number> = {};
  if (pad.mapping !== 'standard') return sum as Direction;
  const add = (axis: string, sign: number): void => void (sum[axis] = (sum[axis] ?? 0) + sign);
  for (const [button, direction] of buttons) {
    if (pad.buttons[button]?.pressed !== true) continue;
    for (const [axis, sign] of Object.entries(direction)) add(axis, sign);
  }
  for (const [stick, axis, sign] of sticks) {
    const way = pad.axes[stick] ?? 0;
    if (Math.abs(way) >= stickCounts) add(axis, Math.sign(way) * sign);
  }
  return Object.fromEntries(Object.entries(sum).map(([axis, sign]) => [axis, Math.sign(sign) as -1 | 0 | 1]).filter(([, sign]) => sign !== 0));
}

export const gamepad = signal(''); // its name; empty: there is none

export function followGamepad(): void {
  let before = '';
  let timer: ReturnType<typeof setInterval> | undefined;
  const pads = (): Gamepad[] => navigator.getGamepads().filter((one): one is Gamepad => one !== null && one.connected);
  const look = (): void => {
    const pad = pads()[0];
    gamepad.value = pad?.id ?? '';
    const may = path.value === 'jog' && windowHasFocus.value && pad !== undefined;
    const direction = may ? directionOf(pad) : {};
    const name = nameOf(direction);
    if (name === before) return;
    before = name;
    press('gamepad', direction);
  };
  effect(() => {
    // What is held while the page or the window changes has to be let go before it counts again.
    const may = path.value === 'jog' && windowHasFocus.value;
    clearInterval(timer);
    timer = undefined;
    if (!may) {
      before = '';
      letGo('gamepad');
      return;
    }
    const pad = pads()[0];
    if (pad !== undefined) before = nameOf(directionOf(pad));
    timer = setInterval(look, lookEvery);
  });
}
