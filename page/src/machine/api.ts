// The requests of docs/api/openapi.json, and what they answer. Lengths are mm, speeds mm/min, times seconds.
import type { Sentence } from '../core/faults';
import { say } from '../core/language';
import { ownerKey } from './owner_key';
import { token } from './token';

export type Place = Record<string, number>;
export type MachineState =
  | 'Offline' | 'Idle' | 'Run' | 'Hold' | 'Jog' | 'Home' | 'Probe' | 'Tool' | 'Line' | 'Check' | 'Door' | 'Alarm' | 'Fault' | 'Sleep';

export interface Job {
  id: number;
  program: number;
  name: string;
  state: 'checking' | 'running' | 'done' | 'stopped' | 'failed' | 'interrupted';
  why: string;
  why_sentence: Sentence | null;
  history: number;
}

// What a request is answered that the machine has taken: statuses of a smaller change are from before it.
export interface Taken {
  ticket: number;
  change: number;
}

// Where a program waits for a person.
export interface Waits {
  for: 'M0' | 'M1' | 'M6';
  line: number; // 0: not known
  tool: number | null; // for M6 alone
  message: string; // what the program says there; lines apart
  free: boolean; // the machine may be jogged, probed, zeroed and homed meanwhile
}

// A handwheel or keypad at the daemon's computer.
export interface Pendant {
  name: string;
  connected: boolean;
  link: boolean; // a wireless one is switched on and within reach
  axis: string | null; // the selected one
  continuous: boolean;
  step: number; // mm or degrees for a detent; 0: none is selected
  share: number; // of the highest speed, in continuous mode
  missed?: number; // edges that a handwheel at the board's pins made too fast to be counted
  refusal: string; // why its last action was refused; empty: it was not
  refusal_sentence: Sentence;
}

// The camera of the machine file.
export interface CameraState {
  state: 'off' | 'connecting' | 'live' | 'waiting';
  age: number | null; // s since the newest picture; null: there is none yet
  problem: string; // of the last attempt; empty: it succeeded
  problem_sentence: Sentence;
}

export interface Status {
  change: number;
  time: number;
  state: MachineState;
  rests: boolean;
  holds: string[];
  trust: 'unknown' | 'commanded' | 'counted' | 'homed';
  lost_place: boolean; // no program starts
  place: Place;
  work_offset?: Place;
  program_zero?: Place | null; // of the program's coordinates, with the tool's offset; null: no program moves
  work_rotation?: number; // degrees about Z
  speed: number;
  line: number;
  board_file?: string | null; // the board runs this file of its own: its lines are not known
  progress: number | null;
  left: number | null; // s, of the job
  outputs: { spindle: 'off' | 'clockwise' | 'counterclockwise'; spindle_speed: number; mist: boolean; flood: boolean };
  overrides: { feed: number; rapids: number; spindle: number };
  stops: { single_block: boolean; optional_stop: boolean };
  inputs: { probe: boolean; door: boolean; hold: boolean; start: boolean; emergency_stop: boolean; limits: number[] };
  waits_for_tool: number | null;
  waits_for_operator: boolean;
  waits?: Waits | null;
  measured_tool?: { tool: number; length: number } | null; // by the last M6 of the program
  trouble: string;
  trouble_sentence: Sentence | null;
  unkept: string; // what is not on the disk yet, and why
  unkept_sentences?: Sentence[];
  owner: { kind: 'nobody' | 'sender' | 'client'; name: string; taken: number };
  pendant?: Pendant | null; // null: none has been connected
  camera?: CameraState | null; // null: there is none
  spindle_drive?: SpindleDrive | null; // null: the board switches the spindle
  job: Job | null;
  // The lines of the console: the modes in force, and where the tool is by them.
  mdi: { codes: string[]; feed: number; speed: number; tool: number; place: Place; streams: boolean; trouble: string; trouble_sentence: Sentence };
}

// The drive of a spindle on RS-485, as it reports.
export interface SpindleDrive {
  answers: boolean;
  at_speed: boolean;
  speed: number; // rpm
  current: number | null; // A
  load: number | null; // a fraction of the rated load
  fault: Sentence | null;
}

export interface MachineAxis {
  axis: string;
  low: number;
  high: number;
  speed: number;
  acceleration?: number;
  steps_per_unit?: number;
  homes: boolean;
}
export interface Motor {
  axis: string;
  second: boolean; // the second one of its axis
  inverted: boolean;
  limit: number | null; // the number of its limit switch
}
export type Level = 'high' | 'low';
export type PinName =
  | 'probe' | 'door' | 'emergency_stop' | 'hold' | 'start' | 'driver_enable' | 'step' | 'spindle' | 'spindle_reverse' | 'mist' | 'flood';
export type Ability =
  | 'exact-resume' | 'step-counts' | 'pulses' | 'adaptive-feed' | 'any-override' | 'single-block' | 'door-hold' | 'probe-state'
  | 'jog' | 'home' | 'home-axis' | 'probe' | 'sleep' | 'set-position' | 'thread' | 'board-files';
export interface MachineAbility {
  ability: Ability;
  can: boolean;
  why: string; // empty: it can
  sentence: Sentence | null;
}
export interface MachineCamera {
  offset: { x: number; y: number }; // from the spindle's axis to the point under the cross-hair
  rotation: 0 | 90 | 180 | 270; // clockwise
  mirrored: boolean; // before the rotation
}
export interface Machine {
  name: string;
  version: string;
  axes: MachineAxis[];
  motors: Motor[];
  pins: Record<PinName, Level> & { limits: Level[] }; // the level at which each is on
  highest_rpm: number;
  top: number | null; // machine Z; null: no axis Z
  park: { x: number; y: number } | null;
  camera?: MachineCamera | null;
  abilities: MachineAbility[];
}

export interface Finding {
  severity: 'error' | 'warning';
  code: string;
  line: number;
  column: number;
  message: string;
  message_sentence: Sentence;
  expected: string;
  expected_sentence: Sentence;
  more_lines: number[];
}
export interface Program {
  id: number;
  name: string;
  dialect: 'linuxcnc' | 'grbl';
  bytes: number;
  lines: number;
  state: 'unchecked' | 'checking' | 'good' | 'bad';
  checks: number; // how many have begun
  seconds: number; // at the programmed speeds
  planned: number | null; // with all ramps; null: not known yet
  moves: number;
  block_delete: boolean; // lines that begin with / are left out
  deleted_lines: number; // how many begin with /
  small: boolean; // made on request, e.g. to frame a job
  height_map: boolean;
  findings?: Finding[];
}

export interface HistoryJob {
  id: number;
  name: string;
  bytes: number;
  state: 'queued' | 'running' | 'done' | 'stopped' | 'failed' | 'interrupted';
  why: string;
  why_sentence: Sentence | null; // null: an older version has written it
  queued_at: number;
  begun_at: number;
  ended_at: number;
  waits?: (Omit<Waits, 'free'> & { at: number })[];
  stills?: { id: number; at: number; moment: 'start' | 'end' }[];
}
export interface Alarm {
  at: number;
  words: string;
  sentence: Sentence | null;
}

// What the machine or the server refuses. Status 0: the server was not reached.
export class Refused extends Error {
  constructor(
    readonly status: number,
    readonly code: string,
    message: string,
    readonly expected = '', // what would have been right
    readonly sentence: Sentence | null = null,
    readonly expectedSentence: Sentence | null = null,
  ) {
    super(message);
  }
}

const base = 'api/v1';

export function headers(): Record<string, string> {
  const all: Record<string, string> = {};
  if (token.value !== '') all.Authorization = `Bearer ${token.value}`;
  if (ownerKey.value !== '') all['X-Passo-Key'] = ownerKey.value;
  return all;
}

async function refusalOf(answer: Response): Promise<Refused> {
  try {
    type Said = { code: string; message: string; expected?: string; sentence?: Sentence; expected_sentence?: Sentence };
    const { error } = (await answer.json()) as { error: Said };
    return new Refused(answer.status, error.code, error.message, error.expected, error.sentence, error.expected_sentence);
  } catch {
    return new Refused(answer.status, 'http.error', answer.statusText);
  }
}

// `type`: of the body. A browser would tell the type that it guesses by the file's ending; .ngc is a game's to some.
export async function ask(method: string, path: string, body?: BodyInit, within = 5000, type = 'application/json'): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(`${base}${path}`, {
      method,
      headers: body === undefined ? headers() : { ...headers(), 'Content-Type': type },
      ...(body === undefined ? {} : { body }),
      signal: AbortSignal.timeout(within),
    });
  } catch {
    throw new Refused(0, 'page.unreached', say('connection.unreached'));
  }
  if (!answer.ok) throw await refusalOf(answer);
  return answer;
}

export const get = async <T>(path: string): Promise<T> => (await (await ask('GET', path)).json()) as T;
export const post = async <T>(path: string, body?: object): Promise<T> =>
  (await (await ask('POST', path, body === undefined ? undefined : JSON.stringify(body))).json()) as T;
export const remove = async (path: string): Promise<unknown> => (await ask('DELETE', path)).json();

export const upload = async <T>(path: string, name: string, text: BodyInit, more = ''): Promise<T> =>
  (await (await ask('POST', `${path}?name=${encodeURIComponent(name)}${more}`, text, 120_000, 'application/octet-stream')).json()) as T;
