// What is shown of a program as a whole: its check, and whether the motors can run it.
import type { Program } from './api';
import type { MotorLoads } from './studies';

export type Overall = Program['state'] | 'warned' | 'lost';
export type OverallLook = 'good' | 'warned' | 'bad' | 'pending';

// `loads`: those of this program; null: not calculated.
export function overallVerdict(program: Pick<Program, 'state' | 'findings'>, loads: Pick<MotorLoads, 'state' | 'verdict'> | null): Overall {
  if (program.state !== 'good') return program.state;
  const torque = loads?.state === 'done' ? loads.verdict : 'safe';
  if (torque === 'lost') return 'lost';
  return torque === 'doubtful' || (program.findings?.length ?? 0) > 0 ? 'warned' : 'good';
}

export function lookOf(verdict: Overall): OverallLook {
  if (verdict === 'bad' || verdict === 'lost') return 'bad';
  return verdict === 'good' || verdict === 'warned' ? verdict : 'pending';
}
