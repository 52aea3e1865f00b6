// What prepares the machine: the work's zero, the way to it, homing. Each asks first, with facts.
import { say } from '../core/language';
import { confirm } from '../core/question';
import { lengthText, lengthUnit } from '../core/units';
import { moveAs } from './actions';
import { machine, status } from './connection';
import { placeWords, workPlace } from './place';

export async function makeZero(which: readonly string[]): Promise<void> {
  const yes = await confirm({
    title: say('jog.zero.ask', { axes: which.map((axis) => axis.toUpperCase()).join(', ') }),
    facts: [say('jog.zero.facts', { place: placeWords(Object.fromEntries(which.map((axis) => [axis, workPlace.value[axis] ?? 0]))) })],
    yes: say('jog.zero'),
    kind: 'plain',
  });
  if (yes) await moveAs('/work', { place: Object.fromEntries(which.map((axis) => [axis, 0])) });
}

export const places = ['zero', 'park', 'g28', 'g30'] as const;
export type Place = (typeof places)[number];

export const whyNotPlace = (place: Place): string =>
  place === 'park' && machine.value?.park === null ? say('goto.park.none') : '';

export async function goToPlace(place: Place): Promise<void> {
  const top = machine.value?.top ?? null;
  const yes = await confirm({
    title: say('goto.ask', { place: say(`goto.${place}`) }),
    facts: [
      top === null ? say('goto.facts.flat') : say('goto.facts', { top: `Z ${lengthText(top)} ${lengthUnit()}` }),
      ...(top !== null && (place === 'g28' || place === 'g30') ? [say('goto.facts.home')] : []),
    ],
    yes: say('goto.go'),
    kind: 'go',
  });
  if (yes) await moveAs('/go', { to: place });
}

export async function home(): Promise<void> {
  const all = machine.value?.axes.filter((one) => one.homes).map((one) => one.axis.toUpperCase()) ?? [];
  const yes = await confirm({
    title: say('jog.home.ask'),
    facts: [say('jog.home.facts', { axes: all.join(', ') })],
    yes: say('jog.home'),
    kind: 'go',
  });
  if (yes) await moveAs('/home');
}

// On boards that can home a single axis.
export async function homeAxis(axis: string): Promise<void> {
  const name = axis.toUpperCase();
  const yes = await confirm({
    title: say('jog.home.ask'),
    facts: [say('jog.home.axis.facts', { axis: name })],
    yes: say('jog.home.axis', { axis: name }),
    kind: 'go',
  });
  if (yes) await moveAs('/home', { axis });
}

// Nobody knows where the machine stands, so nothing but a jog or homing moves it until a person vouches for the place.
export async function vouchForPlace(): Promise<void> {
  const place = status.value?.place;
  if (place === undefined) return;
  const yes = await confirm({
    title: say('jog.here.ask'),
    facts: [say('jog.here.facts', { place: placeWords(place) })],
    yes: say('jog.here'),
    kind: 'plain',
  });
  if (yes) await moveAs('/position', { place });
}
