// The page's one jogger: keys, buttons and touches hold it.
import { effect, signal } from '@preact/signals';
import { kept } from '../core/kept';
import { notify, wordsOfError } from '../core/notices';
import { path } from '../core/route';
import { isTyping } from '../core/typing';
import { asked } from '../core/question';
import { post, type Taken } from './api';
import { connection, machine, status, tell } from './connection';
import { Jogger, type JogWay } from './jogger';
import { beOwner, mayMove } from './owner';

const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);
export const jogStep = kept('jog-step', 0, isNumber); // mm; 0: continuous
export const jogShare = kept('jog-share', 0.25, isNumber); // of the axis's highest speed
export const windowHasFocus = signal(true);
// The direction that is being moved in, for the picture of the pad: "x+", "x+ y-".
export const movesNow = signal('');

export const jogger = new Jogger(
  {
    begin: async (way, lease) => {
      await beOwner();
      return (await post<Taken>('/jog', { ...way, lease })).version;
    },
    renew: () => tell('/jog/renew'),
    stop: () => {
      if (!tell('/stop')) void post('/stop').catch(() => undefined);
    },
  },
  (error) => notify('refused', wordsOfError(error)),
);

export type Direction = Readonly<Record<string, -1 | 0 | 1>>;

export const nameOf = (direction: Direction): string =>
  Object.entries(direction)
    .filter(([, sign]) => sign !== 0)
    .map(([axis, sign]) => axis + (sign > 0 ? '+' : '-'))
    .join(' ');

// The slowest of the axes that take part sets the speed.
export function jogSpeed(direction: Direction): number {
  const speeds = (machine.value?.axes ?? []).filter((one) => (direction[one.axis] ?? 0) !== 0).map((one) => one.speed);
  return (speeds.length === 0 ? 600 : Math.min(...speeds)) * jogShare.value;
}

function wayOf(direction: Direction, distance: number): JogWay {
  const parts = Object.entries(direction).filter(([, sign]) => sign !== 0);
  return { direction: Object.fromEntries(parts), speed: jogSpeed(direction), distance: distance * Math.sqrt(parts.length) };
}

export const canJog = (): boolean =>
  mayMove.value && asked.value === null && (status.value?.state === 'Idle' || status.value?.state === 'Jog');

let heldWay = '';

// In continuous jog this lasts until endHold(); else it is one step.
export function beginHold(direction: Direction): void {
  const name = nameOf(direction);
  if (name === '') return endHold();
  if (!canJog()) return;
  if (jogStep.value > 0) {
    jogger.step(wayOf(direction, jogStep.value));
  } else if (name !== heldWay) {
    heldWay = name;
    jogger.hold(wayOf(direction, 0));
  }
  movesNow.value = name;
}

export function endHold(): void {
  heldWay = '';
  movesNow.value = '';
  if (jogStep.value === 0) jogger.release();
}

// Whatever is held, and whatever step goes on: it ends.
export function endAll(): void {
  held.clear();
  heldWay = '';
  movesNow.value = '';
  jogger.release();
}

export const keyDirections: Readonly<Record<string, Direction>> = {
  ArrowLeft: { x: -1 },
  ArrowRight: { x: 1 },
  ArrowUp: { y: 1 },
  ArrowDown: { y: -1 },
  PageUp: { z: 1 },
  PageDown: { z: -1 },
  Numpad1: { x: -1, y: -1 },
  Numpad2: { y: -1 },
  Numpad3: { x: 1, y: -1 },
  Numpad4: { x: -1 },
  Numpad6: { x: 1 },
  Numpad7: { x: -1, y: 1 },
  Numpad8: { y: 1 },
  Numpad9: { x: 1, y: 1 },
  NumpadAdd: { z: 1 },
  NumpadSubtract: { z: -1 },
};

const held = new Map<string, Direction>();

// Keys together are the sum of their directions; opposite ones rest.
export function sumOf(directions: Iterable<Direction>): Direction {
  const sum: Record<string, -1 | 0 | 1> = {};
  for (const one of directions) {
    for (const [axis, sign] of Object.entries(one)) sum[axis] = Math.sign((sum[axis] ?? 0) + sign) as -1 | 0 | 1;
  }
  return sum;
}

function keyDown(event: KeyboardEvent): void {
  const direction = keyDirections[event.code];
  if (path.value !== 'jog' || event.ctrlKey || event.altKey || event.metaKey) return endAll();
  if (direction === undefined || isTyping(event.target)) return;
  event.preventDefault(); // the page does not scroll
  if (event.repeat || !windowHasFocus.value) return;
  held.set(event.code, direction);
  beginHold(jogStep.value > 0 ? direction : sumOf(held.values()));
}

function keyUp(event: KeyboardEvent): void {
  if (!held.delete(event.code)) return;
  if (held.size === 0) endHold();
  else if (jogStep.value === 0) beginHold(sumOf(held.values()));
}

export function followJog(): void {
  const focus = (): void => {
    windowHasFocus.value = document.hasFocus() && !document.hidden;
    if (!windowHasFocus.value) endAll();
  };
  addEventListener('keydown', keyDown);
  addEventListener('keyup', keyUp);
  addEventListener('focus', focus);
  addEventListener('blur', () => {
    windowHasFocus.value = false;
    endAll();
  });
  addEventListener('pagehide', endAll);
  document.addEventListener('visibilitychange', focus);
  windowHasFocus.value = document.hasFocus();
  effect(() => {
    if (status.value !== null) jogger.heard(status.value.state, status.value.version);
  });
  effect(() => {
    if (path.value !== 'jog' || connection.value !== 'live') endAll();
  });
}
