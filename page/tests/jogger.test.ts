import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { keyDirections, sumOf } from '../src/machine/jog';
import { Jogger, renewEvery, type JogWay } from '../src/machine/jogger';

const right: JogWay = { direction: { x: 1 }, speed: 600, distance: 0 };
const up: JogWay = { direction: { y: 1 }, speed: 600, distance: 0 };
const step: JogWay = { direction: { x: 1 }, speed: 600, distance: 1 };

// A daemon that does as it is told, at once. Its status has a new number with each change.
class Machine {
  said: string[] = [];
  change = 7;
  hears = true;
  refuses = false;
  errors: unknown[] = [];
  readonly jogger = new Jogger(
    {
      begin: async (way) => {
        this.said.push(`begin ${Object.keys(way.direction).join('')}${way.distance > 0 ? way.distance : ''}`);
        await Promise.resolve();
        if (this.refuses) throw new Error('no');
        return ++this.change;
      },
      renew: () => {
        this.said.push('renew');
        return this.hears;
      },
      stop: () => void this.said.push('stop'),
    },
    (error) => this.errors.push(error),
  );
  tells(state: string): void {
    if (state !== 'Jog') ++this.change;
    this.jogger.heard(state, this.change);
  }
  async settle(): Promise<void> {
    await vi.advanceTimersByTimeAsync(0);
  }
}

describe('Jogger', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('renews the lease while something is held, and stops when it is let go', async () => {
    const m = new Machine();
    m.jogger.hold(right);
    await m.settle();
    m.tells('Jog');
    await vi.advanceTimersByTimeAsync(renewEvery * 2);
    expect(m.said).toEqual(['begin x', 'renew', 'renew']);
    m.jogger.release();
    expect(m.said.at(-1)).toBe('stop');
    await vi.advanceTimersByTimeAsync(renewEvery * 5);
    expect(m.said.at(-1)).toBe('stop');
    m.tells('Idle');
    expect(m.jogger.rests).toBe(true);
  });

  it('stops when the key went up while the request was on its way', async () => {
    const m = new Machine();
    m.jogger.hold(right);
    m.jogger.release();
    await m.settle();
    expect(m.said).toEqual(['begin x', 'stop']);
  });

  it('renews the lease while the answer is on its way, as long as the same is held', async () => {
    const said: string[] = [];
    const line = { begin: () => new Promise<number>((done) => setTimeout(() => done(1), renewEvery * 9)), renew: () => said.push('renew') > 0, stop: () => void said.push('stop') };
    const jogger = new Jogger(line, () => undefined);
    jogger.hold(right);
    await vi.advanceTimersByTimeAsync(renewEvery * 3);
    expect(said).toEqual(['renew', 'renew', 'renew']);
    jogger.release();
    await vi.advanceTimersByTimeAsync(renewEvery * 8);
    expect(said).toEqual(['renew', 'renew', 'renew', 'stop']);
  });

  it('brakes before it goes another way', async () => {
    const m = new Machine();
    m.jogger.hold(right);
    await m.settle();
    m.tells('Jog');
    m.jogger.hold(up);
    expect(m.said).toEqual(['begin x', 'stop']);
    m.tells('Jog');
    m.tells('Idle');
    await m.settle();
    expect(m.said).toEqual(['begin x', 'stop', 'begin y']);
  });

  it('does not begin again at the end of the travel', async () => {
    const m = new Machine();
    m.jogger.hold(right);
    await m.settle();
    m.tells('Jog');
    m.tells('Idle');
    await m.settle();
    expect(m.said).toEqual(['begin x']);
  });

  it('lets go when nobody hears its renewals', async () => {
    const m = new Machine();
    m.jogger.hold(right);
    await m.settle();
    m.hears = false;
    await vi.advanceTimersByTimeAsync(renewEvery);
    expect(m.said).toEqual(['begin x', 'renew', 'stop']);
  });

  it('makes as many steps as were asked for, one after the other, and drops them when told to end', async () => {
    const m = new Machine();
    m.jogger.step(step);
    m.jogger.step(step);
    m.jogger.step(step);
    await m.settle();
    expect(m.said).toEqual(['begin x1']);
    m.tells('Jog');
    m.tells('Idle');
    await m.settle();
    expect(m.said).toEqual(['begin x1', 'begin x1']);
    m.jogger.release();
    m.tells('Jog');
    m.tells('Idle');
    await m.settle();
    expect(m.said).toEqual(['begin x1', 'begin x1', 'stop']);
  });

  it('ends a short step that no status has shown', async () => {
    const m = new Machine();
    m.jogger.step(step);
    await m.settle();
    m.tells('Idle');
    expect(m.jogger.rests).toBe(true);
  });

  it('ends a short step whose end was told before its answer came', async () => {
    const m = new Machine();
    m.jogger.step(step);
    m.jogger.heard('Idle', m.change + 2);
    await m.settle();
    expect(m.jogger.rests).toBe(true);
  });

  it('holds on while a busy computer tells what was before the motion', async () => {
    const m = new Machine();
    m.jogger.hold(right);
    await m.settle();
    for (let i = 0; i < 30; ++i) {
      m.jogger.heard('Idle', m.change - 1);
      await vi.advanceTimersByTimeAsync(renewEvery);
    }
    expect(m.said).toEqual(['begin x', ...Array<string>(30).fill('renew')]);
    m.tells('Jog');
    m.tells('Idle');
    expect(m.jogger.rests).toBe(true);
  });

  it('brakes to the end before it goes another way, whatever is told late', async () => {
    const m = new Machine();
    m.jogger.hold(right);
    await m.settle();
    m.jogger.hold(up);
    m.jogger.heard('Idle', m.change - 1);
    await m.settle();
    expect(m.said).toEqual(['begin x', 'stop']);
    m.tells('Idle');
    await m.settle();
    expect(m.said).toEqual(['begin x', 'stop', 'begin y']);
  });

  it('tells a refusal once, and rests', async () => {
    const m = new Machine();
    m.refuses = true;
    m.jogger.hold(right);
    await m.settle();
    expect(m.errors).toHaveLength(1);
    expect(m.jogger.rests).toBe(true);
    await vi.advanceTimersByTimeAsync(1000);
    expect(m.said).toEqual(['begin x']);
  });
});

describe('keys', () => {
  it('add up, and opposite ones rest', () => {
    const of = (...codes: string[]) => sumOf(codes.map((code) => keyDirections[code] ?? {}));
    expect(of('ArrowUp', 'ArrowRight')).toEqual({ x: 1, y: 1 });
    expect(of('ArrowUp', 'ArrowDown')).toEqual({ y: 0 });
    expect(of('Numpad9', 'ArrowLeft')).toEqual({ x: 0, y: 1 });
  });
});
