// A job that was broken off: the banner and the card have one advice.
import { describe, expect, it } from 'vitest';
import { adviceFor } from '../src/machine/advice';
import type { Status } from '../src/machine/api';
import type { Interrupted } from '../src/machine/interrupted';
import { reopen, chosen } from '../src/machine/programs';
import type { Program } from '../src/machine/api';
import { stateWords } from '../src/machine/words';

const broken = (goes_on: boolean, code: string): Interrupted => ({ goes_on, reentry: { code } }) as Interrupted;

describe('a job that was broken off', () => {
  it('is advised by what can be done with it', () => {
    expect(adviceFor(broken(true, ''), 'counted', true)).toBe('resume');
    expect(adviceFor(broken(false, 'reentry.place-unknown'), 'unknown', true)).toBe('home');
    expect(adviceFor(broken(false, 'reentry.place-unknown'), 'unknown', false)).toBe('place');
    expect(adviceFor(broken(false, ''), 'homed', true)).toBe('reenter');
    expect(adviceFor(broken(false, 'reentry.other-file'), 'homed', true)).toBe('drop');
  });

  it('goes before all that the banner says else of a machine at rest', () => {
    const status = { state: 'Idle', lost_place: true, trust: 'unknown', holds: [], trouble: '', job: { name: 'part.ngc', state: 'failed', why: 'lost' } } as unknown as Status;
    expect(stateWords({ status, program: 'open', canHome: true, broken: 'Resume it.' }).next).toBe('Resume it.');
    expect(stateWords({ status: { ...status, job: null }, program: 'open', canHome: true, broken: '' }).next).toContain('machine position is unknown');
    // A machine that cannot be homed is not told to.
    const switchless = stateWords({ status, program: 'open', canHome: false, broken: '' }).next;
    expect(switchless).toContain('machine position is unknown. Jog it');
    expect(stateWords({ status: { ...status, state: 'Alarm' }, program: 'open', canHome: false, broken: '' }).next).not.toContain('ome the machine');
  });
});

describe('a reload', () => {
  const all = [{ id: 1, name: 'part.ngc' }, { id: 2, name: 'newest.ngc' }] as Program[];
  it('opens the program that was open, and no other one of its number', () => {
    reopen(all, { id: 1, name: 'part.ngc' });
    expect(chosen.value).toBe(1);
    chosen.value = null;
    reopen(all, { id: 2, name: 'part.ngc' });
    expect(chosen.value).toBe(null);
  });
});
