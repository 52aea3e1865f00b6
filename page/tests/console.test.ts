// What the console's log has after a line was refused.
import { afterEach, beforeAll, describe, expect, it, vi } from 'vitest';
import type { Status } from '../src/machine/api';
import { connection, status } from '../src/machine/connection';
import { runLine, typeLine } from '../src/machine/console';
import { followLog, log } from '../src/machine/log';

const idle = { state: 'Idle', holds: [], owner: { kind: 'nobody', name: '', taken: 0 }, job: null, trouble: '', mdi: { streams: false, trouble: '' } };
const fault = { code: 'gcode.missing-feed', message: 'no feed rate is set', expected: 'F before the first feed move, or in its block' };
const answer = (body: object, code = 200): Response => new Response(JSON.stringify(body), { status: code });

beforeAll(() => {
  followLog();
  connection.value = 'live';
  status.value = idle as unknown as Status;
});
afterEach(() => vi.unstubAllGlobals());
const refusals = (): string[] => log.value.filter((one) => one.kind === 'refused').map((one) => `${one.words} / ${one.hint}`);

describe('a line that is wrong', () => {
  it('is told once, and what was expected apart from it', async () => {
    vi.stubGlobal('fetch', async (path: string) => (path.endsWith('/owner') ? answer({ key: 'key', taken: 1 }) : answer({ error: fault }, 409)));
    expect(await typeLine('G1 X1')).toBe(false);
    expect(refusals()).toEqual([`${fault.message} / ${fault.expected}`]);
  });

  it('is told once where the page itself has sent it', async () => {
    log.value = [];
    const found = { ...fault, severity: 'error', line: 1, column: 1, more_lines: [] };
    vi.stubGlobal('fetch', async (path: string) => {
      if (path.endsWith('/owner')) return answer({ key: 'key', taken: 1 });
      return answer(path.endsWith('/programs/7') ? { id: 7, state: 'bad', findings: [found] } : { id: 7, programs: [] });
    });
    expect(await runLine('G1 X2')).toBe(false);
    expect(refusals()).toEqual([`${fault.message} / ${fault.expected}`]);
  });

  it('has ended a job with the trouble that was just told: once', () => {
    log.value = [];
    const trouble = 'the limit switch of X closed';
    status.value = { ...idle, state: 'Alarm', trouble, job: { name: 'part.ngc', state: 'failed', why: trouble } } as unknown as Status;
    expect(log.value.filter((one) => one.words.includes(trouble)).length).toBe(1);
  });
});
