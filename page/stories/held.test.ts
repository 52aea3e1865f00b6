// What holds the machine, whatever is touched meanwhile; and what the console remembers.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join, resolve } from 'node:path';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { Place } from '../src/machine/api';
import { passo, sleep, visit } from './kit';
import { beginStage, browser, daemon } from './stage';

const stories = Number(process.env.PASSO_CHROMIUM_STORIES ?? 200);
const root = resolve(import.meta.dirname ?? '.', '../..');
const cases = join(root, '../shared/cases/serve');

beginStage();

// A page that is left gives the motion back; the next one must not come before.
async function leave(page: Page): Promise<void> {
  await page.goto('about:blank');
  await daemon.until((status) => status.owner.kind === 'nobody');
  await page.context().close();
}

// Reproducible: a story that fails is told by its number.
function randomOf(seed: number): () => number {
  let state = seed * 48271 + 11;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

// The jogs that a page has asked for. The status of a jog, and of each moment until the next one, has its change or a later one.
class AskedJogs {
  private readonly begun: { distance: number; change: number }[] = [];
  private waiting = 0;
  constructor(page: Page) {
    page.on('request', (request) => {
      if (!request.url().endsWith('/api/v1/jog')) return;
      const { distance } = request.postDataJSON() as { distance: number };
      this.waiting += 1;
      const answered = async (): Promise<void> => {
        const { change } = (await (await request.response())?.json()) as { change?: number };
        if (change !== undefined) this.begun.push({ distance, change });
      };
      void answered()
        .catch(() => undefined)
        .then(() => (this.waiting -= 1));
    });
  }
  get answered(): boolean {
    return this.waiting === 0;
  }
  // Whether what moves now moves only as long as it is held, and no step explains it.
  isHold(change: number): boolean {
    return this.begunBy(change)?.distance === 0;
  }
  // The step that is under way at this change, and those after it.
  stepsFrom(change: number): number {
    const later = this.begun.filter((one) => one.change > change);
    return later.reduce((sum, one) => sum + one.distance, this.begunBy(change)?.distance ?? 0);
  }
  private begunBy(change: number): { distance: number } | undefined {
    return this.begun.filter((one) => one.change <= change).at(-1);
  }
}

const keys = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'PageUp', 'Numpad9'];
const padButtons = ['Jog X+', 'Jog Y−', 'Jog Z+', 'Jog X− Y+'];

// A person with a keyboard and one mouse.
class Hands {
  private readonly keys = new Set<string>();
  private mouseIsDown = false;
  constructor(
    private readonly page: Page,
    private readonly random: () => number,
  ) {}

  private pick<T>(from: readonly T[]): T {
    return from[Math.floor(this.random() * from.length)] as T;
  }
  act(): Promise<string> {
    const down = (): Promise<string> => this.keyDown();
    const step = (): Promise<string> => this.chooseStep();
    return this.pick([down, down, down, () => this.keyUp(), step, step, () => this.press(), () => this.moveOff(), () => this.twoButtons(), () => this.blur(), () => this.goElse()])();
  }

  private async keyDown(): Promise<string> {
    const key = this.pick(keys);
    this.keys.add(key);
    await this.page.keyboard.down(key);
    return `${key} down`;
  }
  private async keyUp(): Promise<string> {
    const key = this.pick([...this.keys]);
    if (key === undefined) return 'nothing';
    this.keys.delete(key);
    await this.page.keyboard.up(key);
    return `${key} up`;
  }
  // A mouse whose button is held on the pad cannot click elsewhere. The choice itself can.
  private async chooseStep(): Promise<string> {
    const name = this.pick(['Continuous', 'Continuous', '0.1', '1']);
    const choice = this.page.getByRole('radio', { name, exact: true });
    if (this.mouseIsDown) await choice.evaluate((one) => (one as HTMLInputElement).click());
    else await choice.click({ force: true });
    await expect.poll(() => choice.isChecked(), { interval: 5 }).toBe(true);
    return `step ${name}`;
  }
  private async press(): Promise<string> {
    const name = this.pick(padButtons);
    await this.page.getByRole('button', { name, exact: true }).hover({ force: true });
    if (this.mouseIsDown) return `the mouse to ${name}`;
    this.mouseIsDown = true;
    await this.page.mouse.down();
    return `mouse down on ${name}`;
  }
  private async moveOff(): Promise<string> {
    await this.page.mouse.move(400 * this.random(), 600 * this.random());
    if (!this.mouseIsDown) return 'the mouse elsewhere';
    this.mouseIsDown = false;
    await this.page.mouse.up();
    return 'mouse up elsewhere';
  }
  private async twoButtons(): Promise<string> {
    await this.page.mouse.down({ button: 'right' });
    if (this.mouseIsDown) await this.page.mouse.up();
    this.mouseIsDown = false;
    await this.page.mouse.up({ button: 'right' });
    return 'two buttons';
  }
  private async blur(): Promise<string> {
    await this.page.evaluate(() => {
      dispatchEvent(new Event('blur'));
      dispatchEvent(new Event('focus'));
    });
    return 'blur';
  }
  private async goElse(): Promise<string> {
    const pad = this.page.getByRole('button', { name: 'Jog X+', exact: true });
    await this.page.evaluate(() => void (location.hash = '/run'));
    await pad.waitFor({ state: 'detached' });
    await this.page.evaluate(() => void (location.hash = '/jog'));
    await pad.waitFor();
    return 'another page';
  }

  // Lets all go; returns the machine's time just before the last one.
  async letGo(): Promise<number> {
    const last = this.mouseIsDown ? undefined : [...this.keys].at(-1);
    for (const key of this.keys) if (key !== last) await this.page.keyboard.up(key);
    const { time } = await daemon.status();
    if (last !== undefined) await this.page.keyboard.up(last);
    else if (this.mouseIsDown) await this.page.mouse.up();
    return time;
  }
}

const way = (from: Place, to: Place): number => Math.max(...Object.entries(to).map(([axis, at]) => Math.abs(at - (from[axis] ?? 0))));

// One story; returns how long after the last hold the machine moved, by its own clock. A step that was asked for goes on to
// its end.
async function play(page: Page, jogs: AskedJogs, seed: number): Promise<{ after: number; told: string }> {
  const random = randomOf(seed);
  const hands = new Hands(page, random);
  const acts = [`story ${seed}`];
  for (let i = 0; i < 7; ++i) {
    acts.push(await hands.act());
    await sleep(200 * random());
  }
  const told = acts.join(', ');
  const from = await hands.letGo();
  let was = await daemon.status();
  const moving = [was];
  let quietSince = Date.now();
  while (!jogs.answered || was.state !== 'Idle' || Date.now() - quietSince < 250) {
    await sleep(10);
    const now = await daemon.status();
    const moves = now.state === 'Jog' || way(was.place, now.place) > 1e-6;
    if (moves) moving.push(now);
    if (moves || !jogs.answered) quietSince = Date.now();
    expect(now.time - from, `it moves on: ${told}`).toBeLessThan(20);
    was = now;
  }
  // Only now all answers are there, which tell what was a hold and what a step.
  const held = moving.filter(({ change }) => jogs.isHold(change)).at(-1);
  const rest = held ?? moving[0] ?? was;
  expect(way(rest.place, was.place), `farther than its steps: ${told}`).toBeLessThan(jogs.stepsFrom(rest.change) + 0.05);
  return { after: held === undefined ? 0 : held.time - from, told };
}

async function goToZero(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Work zero' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'Go', exact: true }).click();
  await daemon.until(({ state, place }) => state === 'Idle' && Math.hypot(place.x ?? 0, place.y ?? 0) < 0.01);
  await page.getByTestId('state').filter({ hasText: 'Ready' }).waitFor();
}

describe('a jog', () => {
  it(`rests soon after nobody holds it, in ${stories} stories`, async () => {
    const { page, errors } = await visit(browser, daemon, 'jog', { size: { width: 1280, height: 1400 } });
    const jogs = new AskedJogs(page);
    let longest = { after: 0, told: '' };
    for (let seed = 1; seed <= stories; ++seed) {
      const one = await play(page, jogs, seed);
      if (one.after > longest.after) longest = one;
      if (seed % 10 === 0) await goToZero(page); // back from the ends of the travel
    }
    console.log(`at rest ${longest.after.toFixed(2)} s after the last hold at most: ${longest.told}`);
    // 0.3 s, and what a busy computer takes to ask.
    expect(longest.after, longest.told).toBeLessThan(0.6);
    expect(errors).toEqual([]);
    await leave(page);
  });

  it('moves by keys after a click on a step', async () => {
    const { page } = await visit(browser, daemon, 'jog');
    await daemon.until((status) => status.state === 'Idle');
    await page.getByRole('radio', { name: '1', exact: true }).click();
    await page.getByText('Keyboard jogging is on').waitFor();
    await page.getByText('one step per press').waitFor();
    const before = (await daemon.status()).place.y ?? 0;
    await page.keyboard.press('ArrowUp');
    await daemon.until((status) => status.state === 'Idle' && Math.abs((status.place.y ?? 0) - before - 1) < 0.01);
    expect(await page.getByRole('radio', { name: '1', exact: true }).isChecked()).toBe(true);
    // By Tab the choice has the keys, and the page says so.
    await page.getByRole('radio', { name: '1', exact: true }).focus();
    await page.getByText('Keystrokes go to the selected field').waitFor();
    await page.getByText('Click outside the field').waitFor();
    await leave(page);
  });
});

describe('the console', () => {
  it('keeps its modes, shows them, and remembers its lines over a reload', async () => {
    const { page } = await visit(browser, daemon, 'console');
    const type = async (line: string): Promise<void> => {
      await page.getByPlaceholder('A line of G-code').fill(line);
      await page.keyboard.press('Enter');
    };
    const z = (await daemon.status()).place.z ?? 0;
    await type('G91');
    await expect.poll(() => page.getByTestId('modes').innerText()).toContain('G91');
    await type('G0 Z-2');
    await daemon.until((status) => status.state === 'Idle' && Math.abs((status.place.z ?? 0) - z + 2) < 0.01);
    await type('M3 S9000');
    await daemon.until((status) => status.outputs.spindle === 'clockwise' && status.state === 'Line');
    await type('M5');
    await daemon.until((status) => status.outputs.spindle === 'off' && status.state === 'Idle');
    await type('$G');
    await page.getByText('[GC:').waitFor();
    await type('G99.9');
    await expect.poll(() => page.getByPlaceholder('A line of G-code').inputValue()).toBe('G99.9');
    await type('M2');
    await expect.poll(() => page.getByTestId('modes').innerText()).toContain('G90');
    await page.reload();
    await page.getByPlaceholder('A line of G-code').focus();
    await page.keyboard.press('ArrowUp');
    expect(await page.getByPlaceholder('A line of G-code').inputValue()).toBe('M2');
    await leave(page);
  });
});

describe('a case of a user', () => {
  const said = (name: string): Promise<string> =>
    new Promise((done) => {
      const child = spawn('node', [join(cases, name)], { cwd: root, env: { ...process.env, PASSO: passo } });
      let all = '';
      child.stdout.on('data', (bytes: Buffer) => (all += bytes.toString()));
      child.on('exit', () => done(all));
    });
  const here = (name: string): boolean => existsSync(join(cases, name));

  it.skipIf(!here('jog-step-while-held.cjs'))('rests when the key goes up, after a click on a step', async () => {
    const lines = (await said('jog-step-while-held.cjs')).trim().split('\n');
    expect(lines.length).toBe(4);
    for (const line of lines) expect(line).toMatch(/Idle way -?[0-4]\.\d mm/);
  });
  it.skipIf(!here('mdi-is-stateless.cjs'))('types lines whose modes last', async () => {
    const all = await said('mdi-is-stateless.cjs');
    expect(all).toMatch(/G0 Z5 -> Z 55(\.\d+)? /);
    expect(all).toMatch(/M3 S9000 -> .*clockwise/);
  });
});
