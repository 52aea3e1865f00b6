// A program that waits for a person: what the page says, and what it lets a person do, whatever the machine's state is.
import { afterEach, describe, expect, it } from 'vitest';
import { whyNoDone, whyNoJob, whyNoSetUp, whyNoStop } from '../src/machine/actions';
import type { Status, Waits } from '../src/machine/api';
import { connection, status } from '../src/machine/connection';
import { stateWords } from '../src/machine/words';
import { isFree, waits, wordsOfWait } from '../src/machine/waits';

const atM6: Waits = { for: 'M6', line: 12, tool: 5, message: 'Turn the plate over\n6 mm drill', free: true };
function told(state: Status['state'], now: Waits | null, more: Partial<Status> = {}): Status {
  const all = { state, waits: now, holds: [], rests: true, owner: { kind: 'nobody', name: '', taken: 0 }, waits_for_tool: null, mdi: {}, job: null, ...more };
  connection.value = 'live';
  return (status.value = all as unknown as Status);
}
afterEach(() => {
  status.value = null;
  connection.value = 'connecting';
});

describe('a program that waits', () => {
  it('is told with its tool, also after the machine was jogged meanwhile', () => {
    for (const state of ['Tool', 'Idle'] as const) {
      const words = stateWords({ status: told(state, atM6), program: 'open', canHome: true, broken: '' });
      expect(words.title).toBe('Waiting for the operator');
      expect(words.next).toContain('tool 5');
      expect(words.tone).toBe('wait');
    }
    expect(wordsOfWait(atM6)).toBe('M6, line 12, tool 5');
    expect(waits.value.now?.message).toContain('6 mm drill');
  });

  it('lets jog, probe, zero and go on, and no other job begin', () => {
    for (const state of ['Tool', 'Idle'] as const) {
      told(state, atM6);
      expect([isFree.value, whyNoSetUp(), whyNoDone.value, whyNoStop.value]).toEqual([true, '', '', '']);
      expect(whyNoJob.value).not.toBe('');
    }
    told('Hold', { ...atM6, for: 'M0', tool: null }, { holds: ['program'] });
    expect([whyNoSetUp(), whyNoDone.value]).toEqual(['', '']);
  });

  it('moves nothing where the spindle is on, and nothing while something moves', () => {
    told('Tool', { ...atM6, free: false });
    expect(isFree.value).toBe(false);
    expect(whyNoSetUp()).toContain('spindle');
    told('Jog', atM6);
    expect([isFree.value, whyNoSetUp('Jog')]).toEqual([false, '']);
    expect(whyNoDone.value).not.toBe('');
    expect(whyNoSetUp()).not.toBe('');
  });

  it('is none of the set-up mode of the outputs, in which no motor moves', () => {
    told('Hold', { ...atM6, for: 'M0' }, { holds: ['program'], job: { name: 'set-up.ngc', state: 'running' } as Status['job'] });
    expect([waits.value.now, isFree.value]).toEqual([null, false]);
  });
});

describe('a board that is held while nothing goes on', () => {
  const idle = (hold: boolean) =>
    stateWords({ status: told('Idle', null, { holds: ['operator'], inputs: { hold } as Status['inputs'] }), program: 'open', canHome: true, broken: '' });

  it('is not called ready, and the page says how to go on', () => {
    expect(idle(true)).toEqual({ title: 'On hold', next: 'The hold input of the board is active: release it, then press Resume.', tone: 'wait' });
    expect(idle(false).next).toBe('The board is on hold: press Resume, here or at the board.');
  });
});
