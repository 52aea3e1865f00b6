// Jobs that are broken off, and go on by the page's card; and a start amid a program.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { Place } from '../src/machine/api';
import { Board, Daemon, openBrowser, smallMachine, visit } from './kit';

let browser: Browser;
let folder: string;
let machine: string;
beforeAll(async () => {
  browser = await openBrowser();
  folder = mkdtempSync(join(tmpdir(), 'passo-broken-'));
  machine = smallMachine(folder);
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

const part = 'G21 G90 G17\nF900\nG0 X10 Y10 Z-10\nG1 Z-12\nG1 X60\nG2 X60 Y40 J15\nG1 X10\nG1 Y10\nG0 Z0\nM2\n';
const click = (page: Page, name: string | RegExp): Promise<void> =>
  page.getByRole('button', { name, exact: typeof name === 'string' }).first().click();
const agree = (page: Page, name: string): Promise<void> => page.getByRole('dialog').getByRole('button', { name }).click();

async function send(page: Page, daemon: Daemon): Promise<void> {
  await page.goto(`${daemon.address}#/files`);
  await page.setInputFiles('input[type=file]', { name: 'part.ngc', mimeType: 'text/plain', buffer: Buffer.from(part) });
  await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
  await page.goto(`${daemon.address}#/run`);
}
async function home(page: Page, daemon: Daemon): Promise<void> {
  await page.goto(`${daemon.address}#/jog`);
  await click(page, 'Home');
  await agree(page, 'Home');
  await daemon.until((status) => status.trust === 'homed' && status.state === 'Idle');
}
// A board that was just started: nobody knows where its machine stands, and no program starts.
async function vouch(page: Page, daemon: Daemon): Promise<void> {
  await daemon.until((status) => status.lost_place);
  await page.goto(`${daemon.address}#/jog`);
  await click(page, 'Confirm position');
  await agree(page, 'Confirm position');
  await daemon.until((status) => !status.lost_place);
}
async function startPart(page: Page, daemon: Daemon): Promise<void> {
  await send(page, daemon);
  await click(page, 'Start');
  await agree(page, 'Start');
}
const endOf = async (daemon: Daemon): Promise<Place> => (await daemon.until((status) => status.job?.state === 'done', 60_000)).place;
function same(place: Place, other: Place): void {
  for (const [axis, value] of Object.entries(place)) expect(value).toBeCloseTo(other[axis] ?? NaN, 3);
}

describe('a job that was interrupted', () => {
  it('goes on exactly where the machine stands, after the daemon was killed', async () => {
    const board = await Board.start(machine);
    const data = mkdtempSync(join(folder, 'data-'));
    const first = await Daemon.start({ machine, board, data });
    const { page, context, errors } = await visit(browser, first, 'files');
    await vouch(page, first);
    await startPart(page, first);
    await first.until((status) => status.state === 'Run' && status.line === 6);
    await first.end('SIGKILL');
    // The board plays what it holds, and rests. The same page finds the new daemon by itself.
    const second = await Daemon.start({ machine, board, data, port: new URL(first.address).port });
    const card = page.getByRole('region', { name: 'Interrupted' });
    await card.waitFor();
    expect(await card.innerText()).toContain('part.ngc');
    expect(await card.innerText()).toContain('exactly at the current position');
    await expect.poll(() => page.locator('.act.go').getAttribute('title')).toContain('interrupted');
    // Other pages lead to it.
    await page.goto(`${second.address}#/files`);
    await page.getByText('Job part.ngc was interrupted.').waitFor();
    await click(page, 'Show details');
    await click(page, 'Resume here');
    await page.getByRole('dialog').getByText('The spindle starts with the tool at its current position').waitFor();
    await agree(page, 'Resume here');
    const resumed = await endOf(second);
    await card.waitFor({ state: 'detached' });
    // The same part: the board counts the same steps as in an unbroken run.
    const other = await Board.start(machine);
    const whole = await Daemon.start({ machine, board: other });
    const unbroken = await visit(browser, whole, 'files');
    await vouch(unbroken.page, whole);
    await startPart(unbroken.page, whole);
    same(resumed, await endOf(whole));
    expect(errors.filter((one) => !one.includes('Failed to load'))).toEqual([]);
    for (const one of [context, unbroken.context]) await one.close();
    for (const one of [second, whole]) await one.end();
    for (const one of [board, other]) await one.end();
  });

  it('is led back onto its path by a safe way, after the power was cut and the machine is homed', async () => {
    const board = await Board.start(machine);
    const data = mkdtempSync(join(folder, 'data-'));
    const first = await Daemon.start({ machine, board, data });
    const { page, context } = await visit(browser, first, 'jog');
    await home(page, first);
    await startPart(page, first);
    await first.until((status) => status.state === 'Run' && status.line === 7);
    board.cutPower();
    await first.end('SIGKILL');
    const second = await Daemon.start({ machine, board, data, port: new URL(first.address).port });
    const card = page.getByRole('region', { name: 'Interrupted' });
    await page.goto(`${second.address}#/run`);
    await card.waitFor();
    expect(await card.innerText()).toContain('resume.board-reset');
    expect(await page.getByRole('button', { name: 'Resume here' }).count()).toBe(0);
    await card.getByRole('button', { name: 'Home', exact: true }).click();
    await agree(page, 'Home');
    await second.until((status) => status.trust === 'homed' && status.state === 'Idle');
    await card.getByText('Return to the toolpath, step by step').waitFor();
    await expect.poll(() => card.locator('li').count()).toBeGreaterThan(2);
    await card.getByRole('button', { name: 'Return to the toolpath' }).click();
    await page.getByRole('dialog').locator('li').nth(2).waitFor();
    await agree(page, 'Return to the toolpath');
    const place = await endOf(second);
    expect(place.x).toBeCloseTo(10, 2);
    expect(place.y).toBeCloseTo(10, 2);
    await context.close();
    await second.end();
    await board.end();
  });
});

const lap = 'G21 G90\nF900\no1 repeat [3]\nG1 X20\nG1 X0\no1 endrepeat\nM2\n';

describe('a start amid a program', () => {
  it('asks which time of a line is meant, and begins after a length, with the steps in inches', async () => {
    const daemon = await Daemon.start({ machine });
    const { page, context, errors } = await visit(browser, daemon, 'jog', { units: 'inch' });
    await home(page, daemon);
    await page.goto(`${daemon.address}#/files`);
    await page.setInputFiles('input[type=file]', { name: 'lap.ngc', mimeType: 'text/plain', buffer: Buffer.from(lap) });
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await page.goto(`${daemon.address}#/run`);
    await page.locator('.text-line', { hasText: 'G1 X20' }).click();
    await page.locator('.picked-line:visible').getByRole('button', { name: /Start at line 4/ }).click();
    const question = page.getByRole('dialog');
    await question.getByText('that line runs 3 times').waitFor();
    expect(await question.getByRole('button', { name: 'Start' }).getAttribute('aria-disabled')).toBe('true');
    await question.getByRole('textbox', { name: /^Pass/ }).fill('3');
    await question.getByRole('textbox', { name: /^Distance from the start of the line/ }).fill('0.5');
    await page.keyboard.press('Tab');
    await question.locator('li').first().waitFor();
    // Half an inch after X0.
    await question.getByText('X0.5000').first().waitFor();
    await agree(page, 'Start');
    await daemon.until((status) => status.state === 'Run');
    expect((await endOf(daemon)).x).toBeCloseTo(0, 3);
    expect(errors).toEqual([]);
    await context.close();
    await daemon.end();
  });

  it('shows each step before the machine makes it', async () => {
    const daemon = await Daemon.start({ machine });
    const { page, context, errors } = await visit(browser, daemon, 'jog');
    await home(page, daemon);
    await send(page, daemon);
    await page.locator('.text-line', { hasText: 'G1 X10' }).click();
    await page.locator('.picked-line:visible').getByRole('button', { name: /Start at line 7/ }).click();
    const steps = page.getByRole('dialog').locator('li');
    await steps.first().waitFor();
    expect(await steps.last().innerText()).toContain('line 7');
    await agree(page, 'Start');
    await daemon.until((status) => status.state === 'Run' && status.line >= 7);
    same(await endOf(daemon), { x: 10, y: 10, z: 0 });
    expect(errors).toEqual([]);
    await context.close();
    await daemon.end();
  });
});
