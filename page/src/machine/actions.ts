// The actions that are always within reach. `why` tells why one of them cannot be done now; empty: it can.
import { computed } from '@preact/signals';
import { attempt } from '../core/notices';
import { confirm } from '../core/question';
import { say } from '../core/language';
import { durationText } from '../core/time';
import { lengthUnit } from '../core/units';
import { canHome } from './abilities';
import { post, type Program } from './api';
import { connection, status } from './connection';
import { interrupted } from './interrupted';
import { beOwner, ownership } from './owner';
import { rowsOfReach, type PathIndex, type Reach } from './path_index';
import { checkedFromHere, shown, timeOf } from './programs';
import { placeWords, workPlace } from './place';
import { isAtWait, isFree, waits } from './waits';

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

// Jog, zero, probe, home: also while a program waits for a person.
export function whyNoSetUp(...also: string[]): string {
  const why = whyNotOurs();
  if (why !== '' || isFree.value || is(...also)) return why;
  return waits.value.now !== null && is('Tool', 'Hold') ? say('wait.outputs') : stateWhy();
}
// What begins a job.
export const whyNoJob = computed(() => {
  const why = whyNot('Idle');
  return why === '' && waits.value.now !== null ? say('why.waits') : why;
});
export const whyNoDone = computed(() => (status.value !== null && isAtWait(status.value) ? whyNotOurs() : whyNot()));

export const whyNoStart = computed(() => {
  const why = whyNoJob.value;
  if (why !== '') return why;
  if (interrupted.value !== null) return say('why.broken');
  if (status.value?.lost_place === true) return say(canHome.value ? 'state.Idle.unknown' : 'state.Idle.unknown.switchless');
  if (shown.value === null) return say('why.none');
  if (shown.value.state === 'bad') return say('why.bad');
  return shown.value.state === 'checking' || status.value?.job?.state === 'checking' ? say('why.checking') : '';
});
export const whyNoResume = computed(() => whyNot('Hold', 'Door'));
const moving = ['Run', 'Jog', 'Home', 'Probe', 'Tool', 'Line'];
export const whyNoHold = computed(() => (isLost() ? say('why.lost') : is(...moving) || checksJob() ? '' : say('why.still')));
export const whyNoStop = computed(() =>
  isLost() ? say('why.lost') : is(...moving, 'Hold', 'Door', 'Check') || checksJob() || waits.value.now !== null ? '' : say('why.still'),
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
  if (program === null || status.value === null) return;
  let index = null as PathIndex | null;
  await attempt(async () => (index = await checkedFromHere(program.id)));
  if (index !== null) await startAsked(program, index.reach);
}

async function startAsked(program: Program, reach: Reach | null): Promise<void> {
  const yes = await confirm({
    title: say('do.start.ask', { name: program.name }),
    facts: [
      say(reach === null ? 'do.start.still' : 'do.start.facts', { time: durationText(timeOf(program)) }),
      say('do.start.from', { place: placeWords(workPlace.value) }),
    ],
    columns: [`${say('run.work')}, ${lengthUnit()}`, `${say('run.machine')}, ${lengthUnit()}`],
    rows: reach === null ? [] : rowsOfReach(reach),
    yes: say('do.start'),
    kind: 'go',
  });
  if (yes) await moveAs(`/programs/${program.id}/run`);
}

// A stop is asked about only where it loses something: a program that rests in a hold. What moves stops at once.
export async function stop(): Promise<void> {
  const now = status.value;
  if (now !== null && now.rests && (now.state === 'Hold' || isAtWait(now))) {
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
