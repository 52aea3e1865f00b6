// The site of files in the real browser, below a sub-path as on a host of pages. scripts/site.sh --test builds it before.
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, resolve } from 'node:path';
import type { Browser, BrowserContext, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { openBrowser, violations } from './kit';

const folder = process.env.PASSO_SITE ?? resolve(import.meta.dirname ?? '.', '../../build/site');
const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.wasm': 'application/wasm' };
const subPath = '/passo/';

let browser: Browser;
let server: Server;
let address = '';
let foreign = ''; // the page of a teacher, on another host

function serve(): Promise<Server> {
  const started = createServer((request, reply) => {
    const path = decodeURIComponent(new URL(request.url ?? '/', 'http://host').pathname);
    if (path === '/lesson.html') {
      reply.writeHead(200, { 'Content-Type': 'text/html' });
      reply.end(`<!doctype html><html lang="en"><title>Lesson</title><body><main><h1>Lesson</h1>${lesson}</main></body></html>`);
      return;
    }
    const name = path.startsWith(subPath) ? path.slice(subPath.length) : 'elsewhere';
    readFile(join(folder, name.endsWith('/') || name === '' ? `${name}index.html` : name)).then(
      (bytes) => {
        reply.writeHead(200, { 'Content-Type': `${types[extname(name) || '.html'] ?? 'application/octet-stream'}; charset=utf-8` });
        reply.end(bytes);
      },
      () => {
        reply.writeHead(404);
        reply.end();
      },
    );
  });
  return new Promise((done) => started.listen(0, () => done(started)));
}
let lesson = '';

interface Look {
  width?: number;
  theme?: 'dark' | 'light';
}
// A visit, with what must not happen: errors, and requests to other hosts.
async function open(path: string, { width = 1280, theme = 'light' }: Look = {}): Promise<{ context: BrowserContext; page: Page; wrong: string[] }> {
  const context = await browser.newContext({ viewport: { width, height: 844 }, colorScheme: theme, locale: 'en', reducedMotion: 'reduce' });
  const page = await context.newPage();
  const wrong: string[] = [];
  page.on('pageerror', (error) => wrong.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') wrong.push(`${message.text()} ${message.location().url}`);
  });
  page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(address)) wrong.push(`a request to ${request.url()}`);
  });
  await page.goto(address + path);
  return { context, page, wrong };
}

describe.skipIf(!existsSync(join(folder, 'versions.json')))('the site', () => {
  beforeAll(async () => {
    [browser, server] = await Promise.all([openBrowser(), serve()]);
    const { port } = server.address() as AddressInfo;
    address = `http://127.0.0.1:${port}${subPath}`;
    foreign = `http://localhost:${port}/lesson.html`;
  });
  afterAll(async () => {
    await browser?.close();
    server?.close();
  });

  it.each([
    ['latest/index.html', {}],
    ['latest/index.html', { width: 390, theme: 'dark' }],
    ['latest/manual/machine-file.html', { theme: 'dark' }],
    ['latest/ramps/index.html', { width: 390 }],
    ['latest/it/rampe.html', {}],
    ['versions.html', { width: 390 }],
  ] as const)('shows %s, %j', async (path, look) => {
    const { context, page, wrong } = await open(path, look);
    await page.locator('h1').first().waitFor();
    expect(await violations(page)).toEqual([]);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(page.viewportSize()?.width ?? 0);
    expect(wrong).toEqual([]);
    await context.close();
  });

  it('finds words of each language, without a server', async () => {
    const { context, page, wrong } = await open('latest/index.html');
    const field = page.locator('.md-search__input');
    const first = page.locator('.md-search-result__item a').first();
    for (const [word, where] of [['backlash', 'html'], ['G38.2', 'gcode.html'], ['mezzeria', 'it/interpolazione.html'], ['插补', 'zh/chabu.html']] as const) {
      await field.clear();
      await field.pressSequentially(word);
      await field.press('End'); // Chinese comes without keys
      await expect.poll(async () => ((await first.count()) > 0 ? await first.getAttribute('href') : ''), { timeout: 60_000 }).toContain(where);
    }
    expect(wrong).toEqual([]);
    await context.close();
  });

  it('has a Lab whose parts work in every language, with links that hold the view', async () => {
    const { context, page, wrong } = await open('latest/lab/index.html#/lab?to=13,-7', { width: 390, theme: 'dark' });
    await page.locator('.lab-end').waitFor();
    expect(page.url()).toMatch(/\/passo\/\d+\.\d+\/lab\/index\.html#\/lab\?to=13,-7$/);
    for (const part of ['ramps', 'torque', 'loop', 'board', 'driver', 'steps']) {
      await page.locator(`#lab-tab-${part}`).click();
      await page.locator('#lab-part :is(svg, .lab-mode)').first().waitFor();
    }
    expect(await violations(page)).toEqual([]);
    await page.getByLabel('Language').selectOption('it');
    await page.getByRole('heading', { name: 'Laboratorio' }).waitFor();
    expect(await page.getByText('Connection').count()).toBe(0);
    await page.reload();
    await page.getByRole('heading', { name: 'Laboratorio' }).waitFor();
    expect(decodeURIComponent(page.url())).toContain('to=13,-7');
    expect(wrong).toEqual([]);
    await context.close();
  });

  it('gives a teacher code that shows one part in a page of another host', async () => {
    const { context, page } = await open('latest/lab/index.html?lang=it#/lab?part=ramps&steps=24');
    await page.locator('.lab-chart').first().waitFor();
    await page.getByRole('button', { name: 'Incorpora' }).click();
    lesson = await page.locator('.lab-embed textarea').inputValue();
    expect(lesson).toMatch(/^<iframe src="[^"<>]+\?embed&amp;lang=it#\/lab\?part=ramps&amp;steps=24" title="[^"]+"/);
    await page.goto(foreign);
    const lab = page.frameLocator('iframe');
    await lab.locator('.lab-chart').first().waitFor();
    expect(await lab.locator('input').evaluateAll((all) => all.map((one) => (one as HTMLInputElement).value))).toContain('24');
    expect(await lab.locator('.lab-tabs, .site-head').count()).toBe(0);
    expect(await lab.getByRole('link', { name: 'Apri nel laboratorio' }).getAttribute('href')).toMatch(/lab\/index\.html\?lang=it#\/lab\?part=ramps&steps=24$/);
    expect(await violations(page)).toEqual([]);
    // The visitor's own choices are as they were.
    await page.goto(`${address}latest/lab/index.html`);
    await page.getByRole('heading', { name: 'Lab', exact: true }).waitFor();
    await context.close();
  });
});
