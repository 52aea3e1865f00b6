// Random stories of a person at the page "Set up": keys, pointers, a gamepad, clicks on steps, lost focus, other pages,
// questions, a cut network. Whatever happens, an axis moves only while somebody holds it, and 0.3 s longer.
import { afterAll, beforeAll, describe, expect, it, vi } from 'vitest';
import { browser, connection, daemon, Field, path, pressPad } from './jog_world';

vi.mock('../src/core/route', async () => ({ path: (await import('./jog_world')).path }));
vi.mock('../src/machine/connection', async () => {
  const { connection, machine, status, daemon } = await import('./jog_world');
  return { connection, machine, status, tell: (to: string) => daemon.tell(to) };
});
vi.mock('../src/machine/api', async () => ({ post: (await import('./jog_world')).daemon.post.bind((await import('./jog_world')).daemon) }));

const stories = Number(process.env.PASSO_JOG_STORIES ?? 150);
const within = 300; // ms
const look = 20; // ms

// Reproducible: a story that fails is told by its number.
function randomOf(seed: number): () => number {
  let state = seed * 2654435761 + 1;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

let jog: typeof import('../src/machine/jog');
let question: typeof import('../src/core/question');

beforeAll(async () => {
  vi.useFakeTimers();
  browser.begin();
  jog = await import('../src/machine/jog');
  question = await import('../src/core/question');
  const { followGamepad } = await import('../src/machine/gamepad');
  jog.followJog();
  followGamepad();
  daemon.follow();
  await vi.advanceTimersByTimeAsync(100);
});
afterAll(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

type Axis = 'x' | 'y' | 'z';
interface Holder {
  direction: Partial<Record<Axis, -1 | 0 | 1>>;
  lasts: boolean; // pressed in Continuous
  withoutFocus?: boolean; // a pointer may press where the window has no focus
}

// What a person's hands do, and since when each way of each axis is held by nobody any more.
class Person {
  readonly keys = new Map<string, Holder>();
  readonly pointers = new Map<number, Holder>();
  pad: Holder | null = null;
  presses = 0; // that may have asked for a step
  private readonly heldAt = new Map<string, number>();
  constructor(
    private readonly random: () => number,
    private readonly told: string[],
  ) {}

  pick<T>(from: readonly T[]): T {
    return from[Math.floor(this.random() * from.length)] as T;
  }
  private holder(direction: Holder['direction']): Holder {
    const lasts = jog.jogStep.value === 0;
    if (!lasts) ++this.presses;
    return { direction, lasts };
  }
  private counts(one: Holder): boolean {
    const hasFocus = one.withoutFocus === true || (browser.hasFocus && !browser.document.hidden);
    return one.lasts && hasFocus && path.value === 'jog' && !daemon.cut && question.asked.value === null;
  }
  note(): void {
    for (const one of [...this.keys.values(), ...this.pointers.values(), this.pad]) {
      if (one === null || !this.counts(one)) continue;
      for (const [axis, sign] of Object.entries(one.direction)) if (sign !== 0) this.heldAt.set(`${axis}${sign}`, Date.now());
    }
  }
  check(): void {
    if (daemon.moves === null || !daemon.moves.lasts) return;
    for (const [axis, sign] of Object.entries(daemon.moves.direction)) {
      const since = Date.now() - (this.heldAt.get(`${axis}${sign}`) ?? -Infinity);
      if (since > within) throw new Error(`${axis}${sign} still moves ${since} ms after it was let go: ${this.told.join(', ')}`);
    }
  }

  private readonly acts: (() => string)[] = [
    ...Array.from({ length: 3 }, () => (): string => {
      const code = this.pick(Object.keys(jog.keyDirections));
      if (this.keys.has(code)) {
        browser.key('keydown', code, { repeat: true });
        return `${code} repeats`;
      }
      browser.key('keydown', code);
      this.keys.set(code, this.holder(jog.keyDirections[code] ?? {}));
      return `${code} down`;
    }),
    ...Array.from({ length: 2 }, () => (): string => {
      const code = this.pick([...this.keys.keys()]);
      if (code !== undefined) this.up(code);
      return `${code} up`;
    }),
    ...Array.from({ length: 2 }, () => (): string => {
      jog.jogStep.value = this.pick([0, 0, 0.1, 1]);
      browser.click(new Field('radio'));
      return `step ${jog.jogStep.value}`;
    }),
    () => {
      const id = this.pick([1, 2, 3]);
      if (this.pointers.has(id)) return this.pointerUp(id);
      const direction = this.pick([{ x: 1 }, { y: -1 }, { x: -1, y: 1 }, { z: 1 }] as const);
      this.pointers.set(id, { ...this.holder(direction), withoutFocus: !browser.hasFocus || browser.document.hidden });
      pressPad(jog.pressByPointer, id, direction);
      return `pointer ${id} down`;
    },
    () => this.pointerUp(this.pick([...this.pointers.keys()])),
    () => {
      const pressed = this.pick([[], [], [12], [15], [14, 4]]);
      browser.pads = this.random() < 0.2 ? [] : [{ connected: true, id: 'pad', mapping: 'standard', axes: [0, 0, 0, 0], buttons: Array.from({ length: 17 }, (_, i) => ({ pressed: pressed.includes(i) })) }];
      const direction: Holder['direction'] = { ...(pressed.includes(12) ? { y: 1 } : {}), ...(pressed.includes(15) ? { x: 1 } : {}), ...(pressed.includes(14) ? { x: -1, z: -1 } : {}) };
      this.pad = browser.pads.length === 0 || pressed.length === 0 ? null : this.holder(direction);
      // The page looks every 40 ms: until then the step may be chosen anew.
      if (this.pad !== null) this.pad.lasts = true;
      if (this.pad !== null) ++this.presses;
      return `gamepad ${pressed.join('+')}`;
    },
    () => {
      browser.hasFocus = !browser.hasFocus;
      browser.fire(browser.hasFocus ? 'focus' : 'blur');
      return browser.hasFocus ? 'focus' : 'blur';
    },
    () => {
      browser.document.hidden = !browser.document.hidden;
      browser.fire('visibilitychange', {}, browser.document);
      return browser.document.hidden ? 'hidden' : 'seen';
    },
    () => {
      path.value = path.value === 'jog' ? 'run' : 'jog';
      return `page ${path.value}`;
    },
    () => {
      if (question.asked.value !== null) question.asked.value.answer(false);
      else void question.confirm({ title: '', facts: [], yes: '', kind: 'plain' });
      return question.asked.value === null ? 'answered' : 'asked';
    },
    () => {
      browser.focus(this.pick([null, new Field('text'), new Field('radio')]));
      return `focus in ${browser.document.activeElement?.type ?? 'nothing'}`;
    },
    () => {
      browser.key('keydown', 'ControlLeft', { ctrlKey: true });
      browser.key('keyup', 'ControlLeft');
      return 'Ctrl';
    },
    () => {
      daemon.cut = !daemon.cut;
      // The page knows of a cut after a while.
      const cut = daemon.cut;
      setTimeout(() => cut === daemon.cut && (connection.value = cut ? 'lost' : 'live'), cut ? 1700 * this.random() : 0);
      return daemon.cut ? 'cut' : 'mended';
    },
    () => {
      daemon.becomes(daemon.state === 'Idle' ? this.pick(['Run', 'Home']) : 'Idle');
      return `machine ${daemon.state}`;
    },
  ];
  private up(code: string): void {
    this.keys.delete(code);
    browser.key('keyup', code);
  }
  // However a pointer ends: a mouse with two buttons down tells it by a move.
  private pointerUp(id: number | undefined): string {
    if (id === undefined) return 'nothing';
    this.pointers.delete(id);
    const how = this.pick(['pointerup', 'pointercancel', 'lostpointercapture', 'pointermove']);
    browser.pointer(how, id, how === 'pointermove' ? 2 : 0);
    return `${how} ${id}`;
  }

  act(): void {
    this.told.push(this.pick(this.acts)());
  }
  leave(): void {
    for (const code of [...this.keys.keys()]) this.up(code);
    for (const id of [...this.pointers.keys()]) this.pointerUp(id);
    this.pad = null;
    browser.pads = [];
  }
}

async function wait(person: Person, ms: number): Promise<void> {
  for (let waited = 0; waited < ms; waited += look) {
    person.note();
    await vi.advanceTimersByTimeAsync(look);
    person.note();
    person.check();
  }
}

async function play(seed: number): Promise<void> {
  const random = (daemon.random = randomOf(seed));
  const told = [`story ${seed}`];
  const person = new Person(random, told);
  const before = daemon.stepsBegun;
  jog.jogStep.value = 0;
  for (let i = 0; i < 12; ++i) {
    person.act();
    await wait(person, random() < 0.3 ? 20 : 200 * random());
  }
  person.leave();
  await wait(person, within + look);
  expect(daemon.moves?.lasts ?? false, told.join(', ')).toBe(false);
  expect(daemon.stepsBegun - before, told.join(', ')).toBeLessThanOrEqual(person.presses);
  // And the page is not stuck: once all is well again, a key moves the machine, and a step that nobody holds has ended.
  daemon.becomes('Idle');
  Object.assign(browser, { hasFocus: true });
  Object.assign(browser.document, { hidden: false });
  browser.focus(null);
  browser.fire('focus');
  question.asked.value?.answer(false);
  path.value = 'jog';
  daemon.cut = false;
  connection.value = 'live';
  jog.jogStep.value = 0;
  await vi.advanceTimersByTimeAsync(told.includes('cut') ? 6000 : 1000); // what was asked in vain fails by then
  browser.key('keydown', 'ArrowRight');
  await vi.advanceTimersByTimeAsync(150);
  expect(daemon.moves?.direction, told.join(', ')).toEqual({ x: 1 });
  browser.key('keyup', 'ArrowRight');
  await vi.advanceTimersByTimeAsync(within);
  expect(daemon.moves, told.join(', ')).toBeNull();
}

describe('a jog', () => {
  it(
    `lasts as long as somebody holds it, in ${stories} stories`,
    async () => {
      for (let seed = 1; seed <= stories; ++seed) await play(seed);
    },
    1_800_000,
  );

  it('ends when its key goes up, whatever step was clicked meanwhile', async () => {
    jog.jogStep.value = 0;
    browser.key('keydown', 'ArrowRight');
    await vi.advanceTimersByTimeAsync(600);
    expect(daemon.moves?.direction).toEqual({ x: 1 });
    jog.jogStep.value = 10;
    browser.click(new Field('radio'));
    await vi.advanceTimersByTimeAsync(200);
    browser.key('keyup', 'ArrowRight');
    await vi.advanceTimersByTimeAsync(within);
    expect(daemon.moves).toBeNull();
  });

  it('gives the keys back after a click on a step, and says whose they are', async () => {
    browser.click(new Field('radio'));
    expect(jog.fieldHasKeys.value).toBe(true);
    await vi.advanceTimersByTimeAsync(50);
    expect(jog.fieldHasKeys.value).toBe(false);
    expect(browser.document.activeElement).toBeNull();
    expect(browser.key('keydown', 'ArrowRight'), 'and the page does not scroll').toBe(true);
    browser.key('keyup', 'ArrowRight');
    browser.focus(new Field('radio')); // by Tab
    expect(jog.fieldHasKeys.value).toBe(true);
    expect(browser.key('keydown', 'ArrowRight'), 'the choice has it').toBe(false);
    browser.key('keyup', 'ArrowRight');
    browser.focus(null);
    await vi.advanceTimersByTimeAsync(1000);
  });
});
