// A Grbl machine worked from the page alone: on firmware of other people, Grbl 1.1h on an emulated Uno and grblHAL's
// simulator, and on the strict grbl of the tests, which is always there. The simulators share the computer, so places are
// judged, never times.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { Daemon, example, openBrowser, passo, peers, Peer, sleep, strictGrbl, violations, visit } from './kit';

let browser: Browser;
let folder: string;
beforeAll(async () => {
  browser = await openBrowser();
  folder = mkdtempSync(join(tmpdir(), 'passo-grbl-'));
});
// Also after a story that has failed: an emulated chip takes a processor.
const ends: (() => Promise<void>)[] = [];
afterEach(async () => {
  for (const end of ends.splice(0).reverse()) await end();
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

const pictures = process.env.PASSO_BOARD_PICTURES; // a folder, for whoever wants to look
// A state in both themes, and on a phone.
async function look(page: Page, name: string): Promise<void> {
  if (pictures === undefined) return;
  const was = page.viewportSize() ?? { width: 1280, height: 800 };
  for (const theme of ['dark', 'light'] as const) {
    await page.emulateMedia({ colorScheme: theme });
    await page.screenshot({ path: `${pictures}/${name}-${theme}.png` });
  }
  await page.setViewportSize({ width: 360, height: 740 });
  await page.screenshot({ path: `${pictures}/${name}-phone.png` });
  await page.setViewportSize(was);
  await page.emulateMedia({ colorScheme: 'dark' });
}

const click = (page: Page, name: string): Promise<void> => page.getByRole('button', { name, exact: true }).first().click();
const agree = (page: Page, name: string): Promise<void> => page.getByRole('dialog').getByRole('button', { name, exact: true }).click();
const whyDisabled = async (page: Page, name: string): Promise<string> => {
  const button = page.getByRole('button', { name: new RegExp(`^${name}`) }).first(); // its name has the reason too
  expect(await button.getAttribute('aria-disabled'), name).toBe('true');
  return (await button.getAttribute('title')) ?? '';
};

// The board, what serves it, and a page.
interface Bench {
  board: Peer;
  daemon: Daemon;
  page: Page;
  errors: string[];
}

const pace = ['110=3000', '111=3000', '112=3000', '120=200', '121=200', '122=200'];
const run = (...words: string[]): void => void execFileSync(passo, words, { stdio: 'pipe' });

async function bench(board: Peer, address: string, settings: readonly string[], file?: string): Promise<Bench> {
  ends.push(board.end);
  run('board', 'settings', address, ...[...pace, ...settings].flatMap((one) => ['--set', one]));
  const machine = file ?? join(mkdtempSync(join(folder, 'machine-')), 'mine.toml');
  if (file === undefined) run('machine', '--from', address, '-o', machine);
  const daemon = await Daemon.start({ machine, address });
  ends.push(() => daemon.end());
  const { page, context, errors } = await visit(browser, daemon, 'jog', { size: { width: 1280, height: 1000 } });
  ends.push(() => context.close());
  return { board, daemon, page, errors };
}
// What a story needs of a machine beside its board.
interface Wanted {
  switches?: boolean; // of homing
  probe?: boolean; // something that the probe touches, 5 mm below machine zero
  card?: 'grblhal' | 'fluidnc';
}
async function uno({ switches, probe }: Wanted = {}, settings: readonly string[] = []): Promise<Bench> {
  const options: string[] = [];
  if (switches === true) for (const at of ['X:500', 'Y:500', 'Z:250']) options.push('--switch-at', at);
  if (probe === true) options.push('--probe-at', 'Z:-1250'); // steps
  const own = mkdtempSync(join(folder, 'uno-'));
  const program = join(folder, 'grbl_on_uno');
  if (!existsSync(program)) execFileSync(join(peers, 'build.sh'), [program]);
  const line = join(own, 'line');
  const board = await Peer.start([program, join(peers, 'grbl-1.1h-uno.elf'), line, ...options], own, () => existsSync(line));
  return bench(board, `grbl:${line}`, settings);
}
async function strict({ probe, card }: Wanted = {}, settings: readonly string[] = []): Promise<Bench> {
  const options: string[] = [];
  if (probe === true) options.push('--probe-at', 'Z:-5');
  if (card !== undefined) options.push('--card', card);
  const own = mkdtempSync(join(folder, 'strict-'));
  const line = join(own, 'line');
  const board = await Peer.start([strictGrbl, line, ...options], own, () => existsSync(line));
  return bench(board, `grbl:${line}`, settings);
}
let ports = 0;
async function grblHal(settings: readonly string[] = []): Promise<Bench> {
  const own = mkdtempSync(join(folder, 'hal-'));
  const port = 40_000 + ((process.pid + 7919 * ++ports) % 20_000);
  const board = await Peer.start([join(peers, 'grblHAL_sim'), '-n', '-p', String(port), '-t', '1', '-e', 'eeprom.dat'], own, () => existsSync(join(own, 'eeprom.dat')));
  // It says that it has switches, and stands at the high end of its travel.
  return bench(board, `grbl:tcp:127.0.0.1:${port}`, settings, example('machines/router.toml'));
}

const xOf = async (daemon: Daemon): Promise<number> => (await daemon.status()).place.x ?? NaN;

// A key is held, and released: the machine moves, and rests.
async function jogByKey({ daemon, page }: Bench, name: string): Promise<void> {
  await page.getByText('Keyboard jogging is on').waitFor();
  const from = await xOf(daemon);
  await page.keyboard.down('ArrowRight');
  await daemon.until((status) => status.state === 'Jog' && (status.place.x ?? 0) > from + 2);
  await look(page, `${name}-jog`);
  await page.keyboard.up('ArrowRight');
  await daemon.until((status) => status.state === 'Idle' && status.rests);
  const at = await xOf(daemon);
  expect(at).toBeGreaterThan(from + 2);
  await sleep(400);
  expect(await xOf(daemon)).toBe(at);
}

async function zeroHere({ daemon, page }: Bench): Promise<void> {
  await click(page, 'Zero all');
  await agree(page, 'Work zero');
  for (const axis of ['x', 'y', 'z']) await expect.poll(() => page.getByTestId(`work-${axis}`).innerText()).toMatch(/^[-−]?0\.000$/);
  const { place, work_offset: zero } = await daemon.status();
  expect(zero?.x).toBeCloseTo(place.x ?? NaN, 3);
}

async function open({ daemon, page }: Bench, name: string, text: string): Promise<void> {
  await page.goto(`${daemon.address}#/files`);
  await page.setInputFiles('input[type=file]', { name, mimeType: 'text/plain', buffer: Buffer.from(text) });
  await expect.poll(() => page.getByRole('region', { name }).getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings)/);
  await page.goto(`${daemon.address}#/run`);
}
async function start({ page }: Bench): Promise<void> {
  await click(page, 'Start');
  await agree(page, 'Start');
}

async function runHoldOverrideStop(all: Bench, name: string): Promise<void> {
  const { daemon, page } = all;
  const zero = await xOf(daemon);
  await open(all, 'part.ngc', 'G21 G90\nG1 X80 F600\nG1 Y10 F3000\nG1 X0 Y0\nM2\n');
  await start(all);
  await daemon.until((status) => status.state === 'Run' && (status.place.x ?? 0) > zero + 2);
  await look(page, `${name}-run`);
  await click(page, 'Hold');
  await page.getByText('On hold', { exact: true }).waitFor();
  const held = await daemon.until((status) => status.state === 'Hold' && status.rests);
  expect(held.place.x).toBeLessThan(zero + 79);
  expect(held.line).toBe(2);
  await look(page, `${name}-hold`);
  await click(page, 'Increase: Feed');
  await click(page, 'Increase: Feed');
  await page.getByRole('button', { name: /^Feed 120 %/ }).waitFor();
  expect((await daemon.status()).place.x).toBe(held.place.x);
  await click(page, 'Resume');
  await daemon.until((status) => status.state === 'Run' && Math.abs(status.overrides.feed - 1.2) < 1e-6);
  const ended = await daemon.until((status) => status.job?.state === 'done' && status.state === 'Idle');
  expect(ended.place.x).toBeCloseTo(zero, 2);
  // A stop brakes, and the place is known.
  await open(all, 'long.ngc', 'G21 G90\nG1 X90 F600\nM2\n');
  await start(all);
  await daemon.until((status) => status.state === 'Run' && (status.place.x ?? 0) > zero + 2);
  await click(page, 'Stop');
  const stopped = await daemon.until((status) => status.job?.state === 'stopped' && status.state === 'Idle');
  expect(stopped.lost_place).toBe(false);
  expect(stopped.place.x).toBeLessThan(zero + 89);
  await look(page, `${name}-stopped`);
}

// The board has forgotten where it is. A person vouches for the place, and it moves again.
async function confirmPlace({ daemon, page }: Bench): Promise<void> {
  await page.goto(`${daemon.address}#/jog`);
  await page.locator('.state-next', { hasText: /jog it to a known position and confirm it/i }).waitFor();
  expect(await whyDisabled(page, 'Start')).toContain('The machine position is unknown');
  await click(page, 'Confirm position');
  await agree(page, 'Confirm position');
  await daemon.until((status) => !status.lost_place);
}

async function homeByPage({ daemon, page }: Bench): Promise<void> {
  await page.goto(`${daemon.address}#/jog`);
  await click(page, 'Home');
  await agree(page, 'Home');
  await daemon.until((status) => status.trust === 'homed' && status.state === 'Idle', 120_000);
  await page.getByText('Homed', { exact: true }).waitFor();
}

// A program is under way when something befalls the board. The page tells it, and nothing moves by itself.
async function breakOff(all: Bench, happens: string, code: string): Promise<void> {
  const { board, daemon, page } = all;
  const from = await xOf(daemon);
  await start(all);
  await daemon.until((status) => status.state === 'Run' && (status.place.x ?? 0) < from - 2);
  board.say(happens);
  await page.getByText('Board disconnected', { exact: true }).waitFor();
  const { job, lost_place: lost, speed } = await daemon.status();
  expect(job?.why_sentence?.code).toBe(code);
  expect(lost).toBe(true);
  expect(speed).toBe(0);
  expect(await page.locator('.state').innerText()).toContain('was at line 2 of the program');
}
async function resetByPage({ daemon, page }: Bench): Promise<void> {
  await click(page, 'Reset');
  await daemon.until((status) => status.state === 'Idle' && status.lost_place);
  expect(await whyDisabled(page, 'Start')).toContain('The machine position is unknown. Home the machine');
}

type Maker = (wanted?: Wanted, settings?: readonly string[]) => Promise<Bench>;
const boards: [string, string, boolean, Maker][] = [
  ['Grbl 1.1h on an Uno', 'uno', existsSync(peers), uno],
  ['the strict grbl', 'strict', existsSync(strictGrbl), strict],
];
for (const [name, short, isThere, made] of boards) describe.skipIf(!isThere)('a Grbl board', () => {
  it(`with ${name} is jogged, zeroed, run, held, overridden and stopped`, async () => {
    const all = await made();
    const { daemon, page, errors } = all;
    expect(await whyDisabled(page, 'Home')).toContain('$22=0');
    await look(page, `${short}-start`);
    expect(await violations(page)).toEqual([]);
    await jogByKey(all, `${short}`);
    await zeroHere(all);
    await runHoldOverrideStop(all, `${short}`);
    // The console does not make up the settings of a board.
    expect(errors).toEqual([]);
    await page.goto(`${daemon.address}#/console`);
    await page.getByPlaceholder('A line of G-code').fill('$$');
    await page.keyboard.press('Enter');
    await page.getByText('the board has its own settings').first().waitFor();
  });

  it(`with ${name} is unlocked after a limit switch amid a program`, async () => {
    const all = await made({}, ['21=1']);
    const { board, daemon, page, errors } = all;
    await jogByKey(all, `${short}-first`);
    await open(all, 'long.ngc', 'G21 G90\nG1 X60 F600\nM2\n');
    const from = await xOf(daemon);
    await start(all);
    await daemon.until((status) => status.state === 'Run' && (status.place.x ?? 0) > from + 2);
    board.say('limit X 1');
    await page.getByText('Alarm', { exact: true }).waitFor();
    expect(await page.locator('.state').innerText()).toContain('a limit switch closed');
    await look(page, `${short}-alarm`);
    expect(await violations(page)).toEqual([]);
    board.say('limit X 0');
    await click(page, 'Reset');
    await daemon.until((status) => status.state === 'Idle');
    await look(page, `${short}-reset`);
    await confirmPlace(all);
    await look(page, `${short}-unlocked`);
    await jogByKey(all, `${short}-again`);
    expect(errors).toEqual([]);
  });

  it(`with ${name} homes, probes, and goes on after an unplugged line and a power cut`, async () => {
    const all = await made({ switches: true, probe: true }, ['22=1', '24=100', '25=500']);
    const { daemon, page, errors } = all;
    await look(page, `${short}-unhomed`);
    await homeByPage(all);
    await look(page, `${short}-homed`);
    // The surface is found, and is Z0.
    await click(page, 'Probe …');
    await agree(page, 'Probe');
    await expect.poll(async () => (await daemon.status()).work_offset?.z).toBeLessThan(-1);
    await daemon.until((status) => status.state === 'Idle');
    await look(page, `${short}-probed`);
    await open(all, 'far.ngc', 'G21 G90\nG1 X-30 F600\nM2\n');
    await breakOff(all, 'unplug 4', 'grbl.no-answer');
    await look(page, `${short}-unplugged`);
    expect(await violations(page)).toEqual([]);
    await sleep(4000);
    await resetByPage(all);
    await homeByPage(all);
    await page.goto(`${daemon.address}#/run`);
    await breakOff(all, 'power', 'grbl.restarted');
    await look(page, `${short}-power`);
    await resetByPage(all);
    await homeByPage(all);
    // At the line at which it was.
    await page.goto(`${daemon.address}#/run`);
    await page.locator('.text-line', { hasText: 'G1 X-30' }).click();
    await page.locator('.picked-line:visible').getByRole('button', { name: /Start at line 2/ }).click();
    await page.getByRole('dialog').locator('li').first().waitFor();
    await look(page, `${short}-restart`);
    await agree(page, 'Start');
    const ended = await daemon.until((status) => status.job?.state === 'done' && status.state === 'Idle');
    expect(ended.place.x).toBeCloseTo(-30, 2);
    expect(errors).toEqual([]);
  });
});

describe.skipIf(!existsSync(strictGrbl))('a board with a card', () => {
  it('lists its files, takes one, and runs it by itself', async () => {
    const all = await strict({ card: 'grblhal' });
    const { daemon, page, errors } = all;
    await page.goto(`${daemon.address}#/files`);
    const files = page.getByRole('region', { name: 'Files on the board' });
    await files.getByRole('button', { name: 'List', exact: true }).click();
    await files.locator('[data-file="/old.nc"]').waitFor();
    await page.setInputFiles('input[aria-label="Send a file"]', { name: 'part.nc', mimeType: 'text/plain', buffer: Buffer.from('G21 G90\nG1 X60 F600\nG1 X0\nM2\n') });
    const mine = files.locator('[data-file="/part.nc"]');
    await mine.getByText('Text known').waitFor();
    await look(page, 'card-files');
    expect(await violations(page)).toEqual([]);
    // Of the other file nothing is known: the question says so.
    await files.locator('[data-file="/old.nc"]').getByRole('button', { name: 'Run …' }).click();
    await page.getByRole('dialog').getByText('Passo has NOT checked this file').waitFor();
    await look(page, 'card-unchecked');
    await agree(page, 'Cancel');
    await mine.getByRole('button', { name: 'Run …' }).click();
    await page.getByRole('dialog').getByText('Passo checks the file first').waitFor();
    await look(page, 'card-ask');
    await agree(page, 'Run');
    await daemon.until((status) => status.state === 'Run' && status.board_file === '/part.nc' && (status.place.x ?? 0) > 2);
    await page.getByRole('heading', { name: '/part.nc' }).waitFor();
    expect(await page.locator('.state').innerText()).toContain('The board runs /part.nc by itself');
    await look(page, 'card-run');
    expect(await violations(page)).toEqual([]);
    await click(page, 'Hold');
    const held = await daemon.until((status) => status.state === 'Hold' && status.rests);
    await sleep(400);
    expect(await xOf(daemon)).toBe(held.place.x);
    await click(page, 'Resume');
    await daemon.until((status) => status.state === 'Run' && (status.place.x ?? 0) > (held.place.x ?? 0) + 1);
    await click(page, 'Stop');
    const stopped = await daemon.until((status) => status.job?.state === 'stopped' && status.state === 'Idle');
    expect(stopped.lost_place).toBe(false);
    expect(stopped.board_file).toBe(null);
    expect(errors).toEqual([]);
  });
});

describe.skipIf(!existsSync(peers))('a real grblHAL board', () => {
  it('is jogged, zeroed, run, held, overridden and stopped, and its alarm is unlocked', async () => {
    const all = await grblHal(['22=1']);
    const { daemon, page, errors } = all;
    await look(page, 'hal-start');
    await jogByKey(all, 'hal');
    await zeroHere(all);
    await runHoldOverrideStop(all, 'hal');
    await page.goto(`${daemon.address}#/jog`);
    await click(page, 'Home');
    await agree(page, 'Home');
    await page.getByText('Alarm', { exact: true }).waitFor();
    expect(await page.locator('.state').innerText()).toContain('homing found no switch');
    await look(page, 'hal-alarm');
    expect(await violations(page)).toEqual([]);
    await click(page, 'Reset');
    await daemon.until((status) => status.state === 'Idle');
    await confirmPlace(all);
    await look(page, 'hal-unlocked');
    await jogByKey(all, 'hal-again');
    expect(errors).toEqual([]);
  });
});
