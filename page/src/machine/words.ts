// What the machine does, in words, and what a person does next.
import { reportWords } from '../core/faults';
import { say } from '../core/language';
import type { Job, Status } from './api';
import { isAtWait, waitsOf } from './waits';

// What the console runs.
export const consoleName = 'console.ngc';

export type Tone = 'calm' | 'go' | 'wait' | 'bad';

export interface StateWords {
  title: string;
  next: string;
  tone: Tone;
}

const tones: Record<Status['state'], Tone> = {
  Offline: 'wait',
  Idle: 'calm',
  Run: 'go',
  Hold: 'wait',
  Jog: 'go',
  Home: 'go',
  Probe: 'go',
  Tool: 'wait',
  Line: 'calm',
  Check: 'calm',
  Door: 'bad',
  Alarm: 'bad',
  Fault: 'bad',
  Sleep: 'calm',
};

export interface Facts {
  status: Status;
  program: 'none' | 'bad' | 'open';
  canHome: boolean;
  broken: string; // what to do with a job that was broken off; empty: there is none
}

const toolOf = (status: Status): number | null => waitsOf(status)?.tool ?? status.waits_for_tool;

// The board is held, by its input or by another sender, while nothing goes on here.
export const isHeldIdle = (status: Status): boolean => status.state === 'Idle' && status.holds.includes('operator');

function nextOf({ status, program, canHome, broken }: Facts): string {
  const { state } = status;
  if (isAtWait(status)) return toolOf(status) === null ? say('state.Tool.next') : say('state.Tool.tool', { tool: toolOf(status) ?? 0 });
  if (isHeldIdle(status)) return say(status.inputs.hold ? 'state.Idle.hold-input' : 'state.Idle.held');
  if (state === 'Idle') {
    if (broken !== '') return broken;
    // The console itself has told why a line was refused.
    const unknown = status.lost_place ? say(canHome ? 'state.Idle.unknown' : 'state.Idle.unknown.switchless') : '';
    if (status.job?.state === 'failed' && status.job.name !== consoleName) {
      const failed = say('state.Idle.job.failed', { why: reportWords(status.job.why, status.job.why_sentence) });
      return unknown === '' ? failed : `${failed}. ${unknown}`;
    }
    if (unknown !== '') return unknown;
    if (canHome && status.trust !== 'homed' && program === 'none') return say('state.Idle.home');
    return say(program === 'none' ? 'state.Idle.open' : program === 'bad' ? 'state.Idle.bad' : 'state.Idle.next');
  }
  if (state === 'Run' && (status.board_file ?? null) !== null) return say('board.files.runs', { path: status.board_file ?? '' });
  if (state === 'Run') return say('state.Run.next', { line: status.line });
  if (state === 'Line' && status.mdi.streams) return say('state.Line.console');
  if (state === 'Hold' && status.rests && status.holds.includes('line-end')) return say('state.Hold.line');
  const next = say(state === 'Alarm' && !canHome ? 'state.Alarm.switchless' : `state.${state}.next`);
  const trouble = reportWords(status.trouble, status.trouble_sentence);
  return trouble === '' || (state !== 'Alarm' && state !== 'Fault') ? next : `${trouble.charAt(0).toUpperCase()}${trouble.slice(1)}. ${next}`;
}

export function stateWords(facts: Facts): StateWords {
  const { state, rests } = facts.status;
  if (isAtWait(facts.status)) return { title: say('state.Tool'), next: nextOf(facts), tone: tones.Tool };
  if (isHeldIdle(facts.status)) return { title: say('state.Hold'), next: nextOf(facts), tone: tones.Hold };
  const title = state === 'Hold' && !rests ? say('state.Hold.braking') : say(`state.${state}`);
  return { title, next: nextOf(facts), tone: tones[state] };
}

export const isUnderWay = (job: Job | null): boolean => job !== null && (job.state === 'running' || job.state === 'checking');
