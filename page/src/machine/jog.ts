// The page's one jogger: keys, pointers on the pad and a gamepad hold it. A jog ends when what has begun it is let go, and
// with the focus, the page or the connection, whatever else was touched meanwhile.
import { effect, signal } from '@preact/signals';
import { kept } from '../core/kept';
import { notify, wordsOfError } from '../core/notices';
import { path } from '../core/route';
import { isTyping, takesText } from '../core/typing';
import { asked } from '../core/question';
import { post, type Taken } from './api';
import { connection, machine, status, tell } from './connection';
import { Jogger, type JogWay } from './jogger';
import { beOwner, mayMove } from './owner';
import { isFree } from './waits';

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
      return (await post<Taken>('/jog', { ...way, lease })).change;
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

const canJog = (): boolean =>
  path.value === 'jog' && mayMove.value && asked.value === null && (isFree.value || status.value?.state === 'Jog');

// What is held: by a key, by a pointer on the pad, by a gamepad. Whether the machine moves until it is let go or makes
// one step is settled when it is pressed: the choice of steps may change while it is held.
interface Hold {
  direction: Direction;
  lasts: boolean;
}
const holds = new Map<string, Hold>();
let heldWay = '';

// The holder may be one that holds already, and points elsewhere now.
export function press(holder: string, direction: Direction): void {
  if (nameOf(direction) === '' || !canJog()) return letGo(holder);
  const lasts = jogStep.value === 0;
  holds.set(holder, { direction, lasts });
  if (!lasts) jogger.step(wayOf(direction, jogStep.value));
  follow();
}

export function letGo(holder: string): void {
  if (holds.delete(holder)) follow();
}

// Whatever is held, and whatever step goes on: it ends.
export function endAll(): void {
  holds.clear();
  heldWay = '';
  movesNow.value = '';
  jogger.release();
}

// The machine moves in the sum of the directions that are held. Nobody who still holds keeps alive what another has let go.
function follow(): void {
  const all = [...holds.values()];
  movesNow.value = nameOf(sumOf(all.map((one) => one.direction)));
  const way = sumOf(all.filter((one) => one.lasts).map((one) => one.direction));
  const name = nameOf(way);
  if (name === heldWay) return;
  heldWay = name;
  if (name === '') jogger.letGo();
  else if (canJog()) jogger.hold(wayOf(way, 0));
  else endAll();
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

// Keys together are the sum of their directions; opposite ones rest.
export function sumOf(directions: Iterable<Direction>): Direction {
  const sum: Record<string, -1 | 0 | 1> = {};
  for (const one of directions) {
    for (const [axis, sign] of Object.entries(one)) sum[axis] = Math.sign((sum[axis] ?? 0) + sign) as -1 | 0 | 1;
  }
  return sum;
}

// A choice or a slider that has the focus takes the arrow keys, and so does a field for text.
export const fieldHasKeys = signal(false);

function keyDown(event: KeyboardEvent): void {
  const direction = keyDirections[event.code];
  if (path.value !== 'jog' || event.ctrlKey || event.altKey || event.metaKey) return endAll();
  if (direction === undefined) return;
  if (holds.has(event.code)) return event.preventDefault(); // it repeats, and the focus may be in a field meanwhile
  if (isTyping(event.target) || document.querySelector('dialog[open]') !== null) return;
  event.preventDefault(); // the page does not scroll
  if (event.repeat || !windowHasFocus.value) return;
  press(event.code, direction);
}

// A pointer on a button of the pad.
export function pressByPointer(event: PointerEvent, direction: Direction): void {
  if (event.button !== 0 || !canJog()) return;
  (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
  press(`pointer ${event.pointerId}`, direction);
}

// The window hears of each pointer, also when its button of the pad is gone. A mouse that presses a second button tells
// of the first one's end by a move only.
function followPointers(): void {
  const end = (event: PointerEvent): void => letGo(`pointer ${event.pointerId}`);
  for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) addEventListener(type, end, true);
  const look = (event: PointerEvent): void => {
    if ((event.buttons & 1) === 0) end(event);
  };
  addEventListener('pointermove', look, true);
  addEventListener('pointerdown', look, true);
}

// Whoever has clicked a step wants to move by keys next: the choice gives the keys back. By Tab it can still be chosen.
function followFocus(): void {
  const look = (): void => void (fieldHasKeys.value = isTyping(document.activeElement));
  const giveBack = (): void => {
    const field = document.activeElement;
    if (path.value === 'jog' && field instanceof HTMLInputElement && !takesText(field)) field.blur();
  };
  // Later, because a click on a label gives the focus to its field afterwards. A click by the keyboard has no number.
  const clicked = (event: MouseEvent): void => void (event.detail > 0 && setTimeout(giveBack));
  addEventListener('click', clicked, true);
  addEventListener('pointerup', () => void setTimeout(giveBack), true);
  addEventListener('focusin', look);
  addEventListener('focusout', () => void setTimeout(look));
}

export function followJog(): void {
  const focus = (): void => {
    windowHasFocus.value = document.hasFocus() && !document.hidden;
    if (!windowHasFocus.value) endAll();
  };
  addEventListener('keydown', keyDown);
  addEventListener('keyup', (event) => letGo(event.code), true);
  addEventListener('focus', focus);
  addEventListener('blur', () => {
    windowHasFocus.value = false;
    endAll();
  });
  addEventListener('pagehide', endAll);
  document.addEventListener('visibilitychange', focus);
  followPointers();
  followFocus();
  windowHasFocus.value = document.hasFocus();
  effect(() => {
    if (status.value !== null) jogger.heard(status.value.state, status.value.change);
  });
  const goesElse = (): boolean => status.value !== null && !isFree.value && status.value.state !== 'Jog';
  effect(() => {
    if (path.value !== 'jog' || connection.value !== 'live' || asked.value !== null || goesElse()) endAll();
  });
}
