// What the page costs: scripts/page_measures.sh [MOVES]
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { Daemon, example, openBrowser, sleep, visit } from './kit';

const moves = Number(process.argv[2] ?? 1_000_000);
const ticksASecond = 100; // of /proc

// A spiral of short lines.
function program(): string {
  const lines = ['G21 G90 G17 F3000', 'G0 Z5', 'G0 X10 Y0', 'G1 Z-1'];
  for (let i = 1; i <= moves; ++i) {
    const angle = i * 0.002;
    const radius = 10 + (80 * i) / moves;
    lines.push(`X${(radius * Math.cos(angle)).toFixed(3)} Y${(radius * Math.sin(angle)).toFixed(3)}`);
  }
  lines.push('G0 Z5', 'M2', '');
  return lines.join('\n');
}

// All processes that this one has begun, except the daemon.
function browserProcesses(): number[] {
  const parents = new Map<number, number>();
  const daemons = new Set<number>();
  for (const name of readdirSync('/proc')) {
    if (!/^\d+$/.test(name)) continue;
    try {
      const stat = readFileSync(`/proc/${name}/stat`, 'utf8');
      parents.set(Number(name), Number(stat.slice(stat.lastIndexOf(')') + 2).split(' ')[1]));
      if (readFileSync(`/proc/${name}/cmdline`, 'utf8').includes('\0serve\0')) daemons.add(Number(name));
    } catch {
      // It has just ended.
    }
  }
  const ours = (pid: number): boolean => pid === process.pid || (parents.has(pid) && ours(parents.get(pid) ?? 0));
  return [...parents.keys()].filter((pid) => pid !== process.pid && !daemons.has(pid) && ours(pid));
}
// MB by kinds of processes, what is shared counted once. The page itself is in the renderer.
function memory(): Map<string, number> {
  const found = new Map<string, number>();
  for (const pid of browserProcesses()) {
    try {
      const kind = /[\0 ]--type=([a-z-]+)/.exec(readFileSync(`/proc/${pid}/cmdline`, 'utf8'))?.[1] ?? 'browser';
      const kilobytes = Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/smaps_rollup`, 'utf8'))?.[1] ?? 0);
      found.set(kind, (found.get(kind) ?? 0) + kilobytes / 1000);
    } catch {
      // It has just ended.
    }
  }
  return found;
}
function tellMemory(when: string, asked: string): void {
  const all = memory();
  const sum = [...all.values()].reduce((one, other) => one + other, 0);
  tell(`Memory of the browser, ${when}`, `${sum.toFixed(0)} MB`, asked);
  for (const [kind, megabytes] of [...all].sort((one, other) => other[1] - one[1])) tell(`  ${kind}`, `${megabytes.toFixed(0)} MB`, '');
}
// Seconds of processors.
function processorTime(): number {
  let ticks = 0;
  for (const pid of browserProcesses()) {
    try {
      const stat = readFileSync(`/proc/${pid}/stat`, 'utf8');
      const [user, system] = stat.slice(stat.lastIndexOf(')') + 2).split(' ').slice(11, 13).map(Number);
      ticks += (user ?? 0) + (system ?? 0);
    } catch {
      // It has just ended.
    }
  }
  return ticks / ticksASecond;
}

const tell = (what: string, value: string, asked: string): void => console.log(`${what.padEnd(58)} ${value.padStart(10)}   asked: ${asked}`);

async function idle(page: Page): Promise<void> {
  await page.bringToFront();
  await sleep(3000);
  const [before, began] = [processorTime(), performance.now()];
  await sleep(10_000);
  tell('Processor of the idle page (Run, connected)', `${((100 * (processorTime() - before)) / ((performance.now() - began) / 1000)).toFixed(1)} %`, '3 %');
}

// From when the daemon tells a new place by HTTP to when the page shows it.
async function latency(page: Page, daemon: Daemon): Promise<void> {
  const { key } = (await daemon.post('/owner', '{"name": "measure"}')) as { key: string };
  await page.evaluate(() => {
    const shown: [number, number][] = [];
    Object.assign(window, { shown });
    const digits = document.querySelector('[data-testid=work-x]');
    if (digits === null) return;
    new MutationObserver(() => shown.push([performance.timeOrigin + performance.now(), Number(digits.textContent)])).observe(digits, {
      characterData: true,
      childList: true,
      subtree: true,
    });
  });
  await daemon.post('/jog', '{"direction": {"x": 1}, "speed": 1200, "distance": 60, "lease": 9}', key);
  const told: [number, number][] = [];
  for (const end = Date.now() + 2500; Date.now() < end; ) {
    const place = (await daemon.status()).place.x ?? 0;
    told.push([performance.timeOrigin + performance.now(), place]);
    await sleep(3);
  }
  await daemon.until((status) => status.state === 'Idle');
  const shown = await page.evaluate(() => (window as unknown as { shown: [number, number][] }).shown);
  const late: number[] = [];
  for (const [at, place] of told) {
    if (place <= 0.5 || place >= 38) continue;
    const first = shown.find(([, value]) => value >= place - 0.0005);
    if (first !== undefined) late.push(first[0] - at);
  }
  late.sort((a, b) => a - b);
  tell('Position shown after the daemon has it, median', `${(late[late.length >> 1] ?? NaN).toFixed(0)} ms`, '100 ms');
  tell('  95 of 100', `${(late[Math.floor(late.length * 0.95)] ?? NaN).toFixed(0)} ms`, '100 ms');
}

async function large(page: Page, daemon: Daemon, folder: string): Promise<void> {
  const file = join(folder, 'large.ngc');
  writeFileSync(file, program());
  await page.goto(`${daemon.address}#/files`);
  await sleep(500);
  const began = performance.now();
  const time = (): string => `${((performance.now() - began) / 1000).toFixed(2)} s`;
  await page.setInputFiles('input[type=file]', file);
  await page.evaluate(() => (location.hash = '/run'));
  const sent = await daemon.get<{ programs: { id: number; state: string }[] }>('/programs');
  for (let list = sent; list.programs.length === 0; list = await daemon.get('/programs')) await sleep(10);
  tell(`${moves} moves: sent`, time(), '');
  for (;;) {
    const [one] = (await daemon.get<typeof sent>('/programs')).programs;
    if (one?.state === 'good' || one?.state === 'bad') break;
    await sleep(20);
  }
  tell(`${moves} moves: checked`, time(), '');
  await page.locator('.scene:not([data-shown=""])').waitFor({ timeout: 120_000 });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  tell(`${moves} moves: shown`, time(), '3 s on two cores');
  await sleep(1500);
  tellMemory('with it', '500 MB');
  await sleep(10_000);
  tellMemory('10 s later', '500 MB');
}

const folder = mkdtempSync(join(tmpdir(), 'passo-measures-'));
const browser = await openBrowser();
const daemon = await Daemon.start({ machine: example('machines/router.toml') });
const empty = await browser.newPage();
await sleep(5000); // Chromium then has begun all that it keeps in hand
tellMemory('with an empty page', '');
await empty.close();
const { page } = await visit(browser, daemon, 'run');
await idle(page);
await latency(page, daemon);
tellMemory('without a program', '500 MB');
await large(page, daemon, folder);
await browser.close();
await daemon.end();
rmSync(folder, { recursive: true, force: true });
