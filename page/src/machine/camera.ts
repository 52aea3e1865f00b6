// The machine's camera: where its pictures are, what its state means, and what its cross-hair is for.
import { signal } from '@preact/signals';
import { reportWords } from '../core/faults';
import { kept } from '../core/kept';
import { say } from '../core/language';
import { attempt, notify } from '../core/notices';
import { confirm } from '../core/question';
import { lengthText, lengthUnit } from '../core/units';
import { moveAs } from './actions';
import { get, post, type CameraState, type MachineCamera, type Place } from './api';
import { machine } from './connection';
import type { Draft, MachineFile } from './machine_file';
import { beOwner } from './owner';
import { inWork, machinePlace, placeWords, workOffset, workRotation } from './place';
import { token } from './token';

const lateAfter = 2; // s

export const showsCamera = kept('camera', true, (value): value is boolean => typeof value === 'boolean');
export const zooms = [1, 2, 4] as const;
export const zoom = signal<number>(1);
// Where the spindle was when it stood over the dot, in machine coordinates.
export const mark = signal<Place | null>(null);

// A browser cannot send a header for a picture.
const withToken = (address: string): string =>
  token.value === '' ? address : `${address}${address.includes('?') ? '&' : '?'}token=${encodeURIComponent(token.value)}`;
// `attempt`: another one makes the browser ask again.
export const streamAddress = (attempt: number): string => withToken(`api/v1/camera/stream?attempt=${attempt}`);
export const stillAddress = (id: number): string => withToken(`api/v1/history/stills/${id}`);

// Why there is no picture, or only an old one. Empty: the picture is live.
export function cameraWords(camera: CameraState | null | undefined): string {
  if (camera === null || camera === undefined) return '';
  const seconds = Math.floor(camera.age ?? 0);
  const isLate = seconds >= lateAfter;
  if (camera.problem !== '') {
    const why = reportWords(camera.problem, camera.problem_sentence);
    return isLate ? say('camera.late.trouble', { seconds, why }) : say('camera.trouble', { why });
  }
  if (camera.state === 'live') return isLate ? say('camera.late', { seconds }) : '';
  return say('camera.connecting');
}

// Mirrored first, then rotated, then magnified; CSS applies the last one first.
export const turnOf = (camera: MachineCamera, times: number): string =>
  `scale(${times}) rotate(${camera.rotation}deg)${camera.mirrored ? ' scaleX(-1)' : ''}`;

// The point under the cross-hair when the spindle is at this place.
export const underCrossHair = (camera: MachineCamera, spindle: Place): Place => ({
  x: (spindle.x ?? 0) + camera.offset.x,
  y: (spindle.y ?? 0) + camera.offset.y,
});

export async function zeroAtCrossHair(): Promise<void> {
  const camera = machine.value?.camera;
  if (!camera) return;
  const place = inWork(underCrossHair(camera, machinePlace.value), workOffset.value, workRotation.value);
  const yes = await confirm({
    title: say('camera.zero.ask'),
    facts: [say('camera.zero.facts', { place: placeWords({ x: place.x ?? 0, y: place.y ?? 0 }) })],
    yes: say('jog.zero'),
    kind: 'plain',
  });
  if (yes) await moveAs('/work', { place: { x: 0, y: 0 }, cross_hair: true });
}

export async function goToCrossHair(): Promise<void> {
  const top = machine.value?.top ?? null;
  const yes = await confirm({
    title: say('camera.go.ask'),
    facts: [top === null ? say('goto.facts.flat') : say('goto.facts', { top: `Z ${lengthText(top)} ${lengthUnit()}` })],
    yes: say('goto.go'),
    kind: 'go',
  });
  if (yes) await moveAs('/go', { to: 'cross_hair' });
}

// How far the spindle stands from the mark now: the offset, if the cross-hair is over the dot.
export function offsetFrom(marked: Place, now: Place): { x: number; y: number } {
  const off = (axis: 'x' | 'y'): number => Number(((marked[axis] ?? 0) - (now[axis] ?? 0)).toFixed(3));
  return { x: off('x'), y: off('y') };
}

// Values that are being edited in the Machine tab stay as they are.
export async function keepOffset(): Promise<void> {
  if (mark.value === null) return;
  const { x, y } = offsetFrom(mark.value, machinePlace.value);
  const isKept = await attempt(async () => {
    await beOwner();
    const { text, stamp } = await get<MachineFile>('/machine/file');
    const changed = await post<Draft>('/machine/file/draft', { text, set: { 'camera.offset_mm': [x, y] } });
    await post('/machine/file', { text: changed.text, stamp });
  });
  if (!isKept) return;
  mark.value = null;
  notify('done', say('file.later'));
}
