// "Check my program" in the real browser, as files without a server of its own: what somebody does with a program.
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import type { Browser, BrowserContext, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { build } from 'vite';
import { example, openBrowser, violations } from './kit';
import { wasm } from '../vite.modules';

const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.wasm': 'application/wasm' };
const folder = mkdtempSync(join(tmpdir(), 'passo-check-'));
let browser: Browser;
let server: Server;
let address = '';

interface Look {
  width?: number;
  language?: string;
}
async function open({ width = 1280, language = 'en' }: Look = {}): Promise<{ context: BrowserContext; page: Page; wrong: string[] }> {
  const context = await browser.newContext({ viewport: { width, height: 844 }, locale: language, reducedMotion: 'reduce' });
  const page = await context.newPage();
  page.setDefaultTimeout(30_000);
  const wrong: string[] = [];
  page.on('pageerror', (error) => wrong.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') wrong.push(message.text());
  });
  await page.goto(address);
  await page.locator('.check-drop').waitFor();
  return { context, page, wrong };
}
const give = (page: Page, ...files: (string | { name: string; mimeType: string; buffer: Buffer })[]): Promise<void> =>
  page.locator('input[type=file]').setInputFiles(files as string[]);
const file = (name: string, text: string): { name: string; mimeType: string; buffer: Buffer } => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
const wordsOf = async (page: Page, what: string): Promise<string> => (await page.getByTestId(what).innerText()).replace(/\s+/g, ' ');
const pixelsOff = (page: Page): Promise<number> => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

describe.skipIf(!existsSync(wasm['check.wasm']))('check my program', () => {
  beforeAll(async () => {
    process.env.PASSO_SITE_PAGE = 'check';
    process.env.PASSO_SITE_OUT = folder;
    await build({ configFile: 'vite.site.config.ts', logLevel: 'warn' });
    server = createServer((request, reply) => {
      const path = join(folder, new URL(request.url ?? '/', 'http://host').pathname.replace(/\/$/, '/index.html'));
      if (!path.startsWith(folder) || !existsSync(path)) return reply.writeHead(404).end();
      return reply.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'text/plain' }).end(readFileSync(path));
    });
    await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
    address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/check/`;
    browser = await openBrowser();
  });
  afterAll(async () => {
    await browser?.close();
    server?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  it('tells the time and the limits of a good program, without a server', async () => {
    const { page, context, wrong } = await open();
    const requests: string[] = [];
    await page.waitForLoadState('networkidle');
    await give(page, example('engrave.ngc'));
    expect(await wordsOf(page, 'badges')).toBe('No errors Motors: not described');
    expect(await wordsOf(page, 'times')).toContain('Time in motion 0:45 (at feed 0:39, rapid 0:06)');
    await expect.poll(() => page.locator('.scene').getAttribute('data-shown')).not.toBe('');
    // The rest without a network: another machine, and another check.
    await context.setOffline(true);
    page.on('request', (request) => requests.push(request.url()));
    await page.getByRole('combobox', { name: /^Machine/ }).selectOption('strong-router.toml');
    await expect.poll(() => wordsOf(page, 'badges')).toContain('Motors: lose steps');
    expect(requests.filter((one) => !one.startsWith('blob:'))).toEqual([]);
    expect(await violations(page)).toEqual([]);
    expect(wrong).toEqual([]);
    await context.close();
  });

  it('shows an error at its place, in words of the language', async () => {
    const { page, context } = await open({ width: 390, language: 'it' });
    await give(page, file('wrong.ngc', 'G21\nG1 X10 F600\nG1 X9000\nG2 X30 Y30 R1\n'));
    expect(await wordsOf(page, 'badges')).toContain('2 errori');
    const findings = page.getByTestId('findings').locator('li.error');
    expect(await findings.nth(0).innerText()).toContain('Riga 3, colonna 4');
    expect(await findings.nth(0).locator('pre').innerText()).toBe('G1 X9000\n   ^^^^^');
    await findings.nth(0).getByRole('button').click();
    await expect.poll(() => page.locator('.text-line.picked').innerText()).toContain('X9000');
    expect(await pixelsOff(page)).toBe(0);
    expect(await violations(page)).toEqual([]);
    await context.close();
  });

  it('tells in which line a motor loses steps', async () => {
    const { page, context } = await open();
    await give(page, example('troubles/too-fast.ngc'), example('troubles/too-fast.toml'));
    expect(await wordsOf(page, 'badges')).toBe('No errors Motors: lose steps');
    expect(await wordsOf(page, 'motors')).toContain('Line 3 X needs');
    expect(await wordsOf(page, 'proposals')).toContain('rapid override of 50 %');
    await context.close();
  });

  it('takes a machine from the settings of another controller', async () => {
    const { page, context } = await open();
    const fluid = 'axes:\n  x:\n    steps_per_mm: 320\n    max_rate_mm_per_min: 4000\n    acceleration_mm_per_sec2: 300\n    max_travel_mm: 300\n    homing:\n      positive_direction: false\n      mpos_mm: 0\n    motor0:\n      stepstick:\n        step_pin: gpio.1\n        direction_pin: gpio.2\n';
    await give(page, file('m.yaml', fluid), file('p.ngc', 'G21\nG1 X100 F3000\nG1 X400\n'));
    expect(await wordsOf(page, 'badges')).toContain('1 error');
    expect(await page.locator('.check-notes').innerText()).toContain('FluidNC');
    const mach3 = '<profile><Preferences><Units>1</Units><Steps0>200</Steps0><Vel0>50</Vel0><Acc0>300</Acc0><Motor0Active>1</Motor0Active><SLMin0>0</SLMin0><SLMax0>600</SLMax0></Preferences></profile>';
    await give(page, file('m.xml', mach3));
    await expect.poll(() => wordsOf(page, 'badges')).toContain('No errors');
    await give(page, file('bad.yaml', 'a: [\n'));
    expect(await wordsOf(page, 'refused')).toContain('bad.yaml');
    await context.close();
  });

  it('ends a check at once, and refuses what is too large', async () => {
    const { page, context } = await open();
    const lines = Array.from({ length: 300_000 }, (_, i) => `G1 X${i % 300} Y${(i * 7) % 200} F5000`);
    const long = join(folder, 'long.ngc');
    writeFileSync(long, `G21\n${lines.join('\n')}\n`);
    await give(page, long);
    await page.getByRole('progressbar').waitFor();
    await page.getByRole('button', { name: 'Cancel' }).click();
    expect(await wordsOf(page, 'refused')).toContain('cancelled');
    writeFileSync(long, Buffer.alloc(201_000_000, 'G1 X1\n'));
    await give(page, long);
    await expect.poll(() => wordsOf(page, 'refused')).toContain('The program has 201 MB');
    await context.close();
  });
});
