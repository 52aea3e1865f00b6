// What the machine does, in words, and what a person does next.
import { say } from '../core/language';
import { toldOr } from '../core/told';
import type { Job, Status } from './api';

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
}

function nextOf({ status, program, canHome }: Facts): string {
  const { state } = status;
  if (state === 'Idle') {
    // The console itself has told why a line was refused.
    if (status.job?.state === 'failed' && status.job.name !== consoleName) return say('state.Idle.job.failed', { why: toldOr(status.job.why) });
    if (status.lost_place) return say('state.Idle.unknown');
    if (canHome && status.trust !== 'homed' && program === 'none') return say('state.Idle.home');
    return say(program === 'none' ? 'state.Idle.open' : program === 'bad' ? 'state.Idle.bad' : 'state.Idle.next');
  }
  if (state === 'Run') return say('state.Run.next', { line: status.line });
  if (state === 'Line' && status.mdi.streams) return say('state.Line.console');
  if (state === 'Hold' && waitsForPerson(status)) return say('state.Tool.next');
  if (state === 'Hold' && status.rests && status.holds.includes('line-end')) return say('state.Hold.line');
  if (state === 'Tool') {
    return status.waits_for_tool === null ? say('state.Tool.next') : say('state.Tool.tool', { tool: status.waits_for_tool });
  }
  const next = say(`state.${state}.next`);
  const trouble = toldOr(status.trouble);
  return trouble === '' || (state !== 'Alarm' && state !== 'Fault') ? next : `${trouble}. ${next}`;
}

// At M0 and M1, where nobody holds the program besides.
export const waitsForPerson = ({ holds }: Status): boolean =>
  holds.includes('program') && !['operator', 'door', 'line-end'].some((reason) => holds.includes(reason));

export function stateWords(facts: Facts): StateWords {
  const { state, rests } = facts.status;
  if (state === 'Hold' && waitsForPerson(facts.status)) return { title: say('state.Tool'), next: nextOf(facts), tone: tones.Tool };
  const title = state === 'Hold' && !rests ? say('state.Hold.braking') : say(`state.${state}`);
  return { title, next: nextOf(facts), tone: tones[state] };
}

export const isUnderWay = (job: Job | null): boolean => job !== null && (job.state === 'running' || job.state === 'checking');
