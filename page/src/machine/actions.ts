// The actions that are always within reach. `why` tells why one of them cannot be done now; empty: it can.
import { computed } from '@preact/signals';
import { attempt } from '../core/notices';
import { confirm } from '../core/question';
import { say } from '../core/language';
import { durationText } from '../core/time';
import { lengthText, lengthUnit } from '../core/units';
import { post } from './api';
import { connection, status } from './connection';
import { interrupted } from './interrupted';
import { beOwner, ownership } from './owner';
import { pathBox } from './path_index';
import { shown, timeOf } from './programs';
import { placeWords, workPlace } from './place';

const stateWhy = (): string => {
  if (status.value?.state === 'Line' && status.value.mdi.streams) return say('state.Line.console');
  const state = status.value?.state;
  return state === undefined ? say('why.lost') : say('why.state', { state: say(`state.${state}`) });
};
const isLost = (): boolean => connection.value !== 'live' || status.value === null;
const is = (...states: string[]): boolean => states.includes(status.value?.state ?? '');

// Why this page may ask for no motion, whatever the machine does.
export const whyNotOurs = (): string => (isLost() ? say('why.lost') : ownership.value === 'other' ? say('why.other') : '');
// Why a request that moves cannot be made in these states.
export function whyNot(...states: string[]): string {
  const why = whyNotOurs();
  return why !== '' || is(...states) ? why : stateWhy();
}

export const whyNoStart = computed(() => {
  const why = whyNot('Idle');
  if (why !== '') return why;
  if (interrupted.value !== null) return say('why.broken');
  if (status.value?.lost_place === true) return say('state.Idle.unknown');
  if (shown.value === null) return say('why.none');
  if (shown.value.state === 'bad') return say('why.bad');
  return shown.value.state === 'checking' || status.value?.job?.state === 'checking' ? say('why.checking') : '';
});
export const whyNoResume = computed(() => whyNot('Hold', 'Door'));
const moving = ['Run', 'Jog', 'Home', 'Probe', 'Tool', 'Line'];
export const whyNoHold = computed(() => (isLost() ? say('why.lost') : is(...moving) || checksJob() ? '' : say('why.still')));
export const whyNoStop = computed(() =>
  isLost() ? say('why.lost') : is(...moving, 'Hold', 'Door', 'Check') || checksJob() ? '' : say('why.still'),
);
const checksJob = (): boolean => status.value?.job?.state === 'checking';

export const moveAs = (path: string, body?: object): Promise<boolean> =>
  attempt(async () => {
    await beOwner();
    await post(path, body);
  });

export const hold = (): Promise<boolean> => attempt(() => post('/hold'));
export const resume = (): Promise<boolean> => moveAs('/resume');
export const done = (): Promise<boolean> => moveAs('/operator-done');
export const reset = (): Promise<boolean> => moveAs('/reset');
export const wake = (): Promise<boolean> => moveAs('/wake');

export async function start(): Promise<void> {
  const program = shown.value;
  const now = status.value;
  if (program === null || now === null) return;
  const box = pathBox.value;
  const rows: [string, string][] = (box === null ? [] : ['x', 'y', 'z']).map((axis, i) => [
    axis.toUpperCase(),
    `${lengthText(box?.low[i] ?? 0)} … ${lengthText(box?.high[i] ?? 0)} ${lengthUnit()}`,
  ]);
  const yes = await confirm({
    title: say('do.start.ask', { name: program.name }),
    facts: [
      say('do.start.facts', { time: durationText(timeOf(program)) }),
      say('do.start.from', { place: placeWords(workPlace.value) }),
    ],
    rows,
    yes: say('do.start'),
    kind: 'go',
  });
  if (yes) await moveAs(`/programs/${program.id}/run`);
}

// A stop is asked about only where it loses something: a program that rests in a hold. What moves stops at once.
export async function stop(): Promise<void> {
  const now = status.value;
  if (now !== null && now.state === 'Hold' && now.rests) {
    const yes = await confirm({
      title: say('do.stop.ask'),
      facts: [say('do.stop.facts', { progress: Math.floor((now.progress ?? 0) * 100) })],
      yes: say('do.stop'),
      kind: 'stop',
    });
    if (!yes) return;
  }
  await attempt(() => post('/stop'));
}
