import { afterEach, describe, expect, it, vi } from 'vitest';
import { checkedFromHere, programs } from '../src/machine/programs';

const answer = (body: unknown): Response => new Response(JSON.stringify(body), { status: 200, headers: { 'Content-Type': 'application/json' } });

// The daemon: each request of the programs has the next of these states.
function serve(states: string[]): void {
  vi.stubGlobal('fetch', async (path: string) => {
    if (path.endsWith('/path')) return answer({ complete: true, growing: false, reach: null });
    if (!path.endsWith('/programs')) return answer({});
    return answer({ programs: [{ id: 1, name: 'part.ngc', state: states.length > 1 ? states.shift() : states[0] }] });
  });
}
afterEach(() => {
  vi.unstubAllGlobals();
  programs.value = [];
});

describe('a program that is about to start', () => {
  it('is checked to the end, also if its toolpath is complete before', async () => {
    serve(['checking', 'checking', 'checking', 'good']);
    expect((await checkedFromHere(1))?.complete).toBe(true);
    expect(programs.value[0]?.state).toBe('good');
  });

  it('does not start if the check finds an error behind its toolpath', async () => {
    serve(['checking', 'checking', 'bad']);
    expect(await checkedFromHere(1)).toBeNull();
  });
});
