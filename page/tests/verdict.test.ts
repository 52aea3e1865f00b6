// The verdict of a program, with its check and the torque of the motors.
import { describe, expect, it } from 'vitest';
import type { Finding, Program } from '../src/machine/api';
import type { Verdict } from '../src/machine/studies';
import { lookOf, overallVerdict } from '../src/machine/verdict';

const program = (state: Program['state'], findings: Finding[] = []): Pick<Program, 'state' | 'findings'> => ({ state, findings });
const loads = (verdict: Verdict) => ({ state: 'done' as const, verdict });

describe('the verdict of a program', () => {
  it('is never good where steps are lost', () => {
    expect(overallVerdict(program('good'), loads('lost'))).toBe('lost');
    expect(overallVerdict(program('good', [{} as Finding]), loads('lost'))).toBe('lost');
    expect(lookOf('lost')).toBe('bad');
  });

  it('has warnings of the check, or of the motors', () => {
    expect(overallVerdict(program('good'), loads('safe'))).toBe('good');
    expect(overallVerdict(program('good'), loads('doubtful'))).toBe('warned');
    expect(overallVerdict(program('good', [{} as Finding]), null)).toBe('warned');
    expect(overallVerdict(program('good'), { state: 'running', verdict: 'safe' })).toBe('good');
  });

  it('is that of the check where the program is not good', () => {
    for (const state of ['bad', 'checking', 'unchecked'] as const) expect(overallVerdict(program(state), loads('lost'))).toBe(state);
    expect([lookOf('bad'), lookOf('checking'), lookOf('good'), lookOf('warned')]).toEqual(['bad', 'pending', 'good', 'warned']);
  });
});
