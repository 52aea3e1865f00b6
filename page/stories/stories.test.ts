// Whole stories, in the real browser, against the real daemon and its virtual machine. What has moved is asked of the
// daemon.
import type { Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { Daemon, sleep, violations, visit } from './kit';
import { beginStage, browser, daemon } from './stage';

beginStage();
// What a story that failed has left must not spoil the next.
beforeEach(async () => {
  if ((await daemon.status()).state !== 'Idle') await rest();
});

const part = 'G21 G90 G17\nF1200\nG0 Z5\nG0 X10 Y10\nG1 Z-1\nG1 X60\nG2 X60 Y40 J15\nG1 X10\nG1 Y10\nG0 Z5\nM2\n';
const click = (page: Page, name: string | RegExp): Promise<void> => page.getByRole('button', { name, exact: typeof name === 'string' }).first().click();
const send = (page: Page, name: string, text: string): Promise<void> =>
  page.setInputFiles('input[type=file]', { name, mimeType: 'text/plain', buffer: Buffer.from(text) });

async function startProgram(page: Page): Promise<void> {
  await click(page, 'Start');
  await page.getByRole('dialog').getByRole('button', { name: 'Start' }).click();
}
// The motion may still be another page's that is gone.
async function takeOver(page: Page): Promise<void> {
  if ((await daemon.status()).owner.kind !== 'client') return;
  await click(page, 'Take control');
  await page.getByRole('dialog').getByRole('button', { name: 'Take control' }).click();
  await page.locator('.owner').waitFor({ state: 'detached' });
}
async function rest(): Promise<void> {
  await fetch(`${daemon.address}api/v1/stop`, { method: 'POST' });
  await daemon.until((status) => status.state === 'Idle');
}

describe('first start to first cut', () => {
  it('homes, jogs, zeroes, uploads, checks and runs', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'jog');
    await click(page, 'Home');
    await page.getByRole('dialog').getByRole('button', { name: 'Home' }).click();
    await daemon.until((status) => status.trust === 'homed' && status.state === 'Idle');
    await page.getByText('Homed').waitFor();
    // Steps so short that no lease ends amid them, however busy the computer is.
    await page.getByRole('radio', { name: '1', exact: true }).check();
    const at = (await daemon.status()).place;
    await click(page, 'Jog X+');
    await daemon.until((status) => status.state === 'Idle' && Math.abs((status.place.x ?? 0) - (at.x ?? 0) - 1) < 0.01);
    // The part has to fit between the switches.
    for (let steps = 1; steps <= 6; ++steps) {
      await click(page, 'Jog Z−');
      await daemon.until((status) => status.state === 'Idle' && Math.abs((status.place.z ?? 0) - (at.z ?? 0) + steps) < 0.01);
    }
    await click(page, 'Zero all');
    await page.getByRole('dialog').getByRole('button', { name: 'Work zero' }).click();
    await expect.poll(() => page.getByTestId('work-x').innerText()).toBe('0.000');
    await page.goto(`${daemon.address}#/files`);
    await send(page, 'part.ngc', part);
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await page.getByText('X 10.00 … 60.00 mm').waitFor();
    await click(page, 'Open');
    await startProgram(page);
    await daemon.until((status) => status.state === 'Run' && status.line >= 6);
    await expect.poll(() => page.locator('.text-line.executed').count()).toBe(1);
    const ended = await daemon.until((status) => status.job?.state === 'done');
    expect((ended.place.x ?? 0) - (ended.work_offset?.x ?? 0)).toBeCloseTo(10, 3);
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('the question before a start', () => {
  it('names the limits of all moves, rapids and G53 included, in work and machine coordinates, from where the tool is now', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files');
    await takeOver(page);
    const { key } = (await daemon.post('/owner', '{"name": "story"}')) as { key: string };
    await send(page, 'far.ngc', 'G21 G90 F600\nG0 X60 Y50\nG1 X0 Y0\nX5\nG53 G0 Z-1\nG91 G0 X7\nM2\n');
    await expect.poll(() => page.getByRole('region', { name: 'far.ngc' }).getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    // The tool is moved after the check.
    await daemon.post('/jog', '{"direction": {"y": 1}, "speed": 3000, "distance": 3, "lease": 5}', key);
    const { place, work_offset: offset = {} } = await daemon.until((status) => status.state === 'Idle' && status.rests);
    await fetch(`${daemon.address}api/v1/owner`, { method: 'DELETE', headers: { 'X-Passo-Key': key } });
    await page.locator('.owner').waitFor({ state: 'detached' });
    // A reload opens what was open, though there is a newer program.
    await daemon.post('/programs?name=newer.ngc', 'G21 G90\nG0 X1\nM2\n');
    await page.reload();
    await page.getByRole('region', { name: 'far.ngc' }).waitFor();
    await expect.poll(() => page.locator('.act.go').getAttribute('aria-disabled')).toBe('false');
    await click(page, 'Start');
    const row = async (axis: string): Promise<number[]> =>
      [...(await page.getByRole('dialog').getByRole('row', { name: axis }).innerText()).matchAll(/-?\d+\.\d+/g)].map(Number);
    const near = (axis: string, low: number, high: number): Promise<void> =>
      expect.poll(() => row(axis)).toEqual([low, high, low + (offset[axis.toLowerCase()] ?? 0), high + (offset[axis.toLowerCase()] ?? 0)].map((one) => expect.closeTo(one, 2)));
    const at = (axis: string): number => (place[axis] ?? 0) - (offset[axis] ?? 0);
    await near('X', Math.min(0, at('x')), Math.max(60, at('x')));
    await near('Y', Math.min(0, at('y')), Math.max(50, at('y')));
    await near('Z', Math.min(-1 - (offset.z ?? 0), at('z')), Math.max(-1 - (offset.z ?? 0), at('z')));
    await page.getByRole('dialog').getByRole('button', { name: 'Cancel' }).click();
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('a program on its way', () => {
  it('is held, overridden, seen by another page, and finished', async () => {
    const first = await visit(browser, daemon, 'files');
    await send(first.page, 'slow.ngc', part.replace('F1200', 'F400'));
    // Another program may be open until this one is there.
    await expect.poll(() => first.page.getByRole('region', { name: 'slow.ngc' }).getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await first.page.goto(`${daemon.address}#/run`);
    await takeOver(first.page);
    await startProgram(first.page);
    await daemon.until((status) => status.state === 'Run');
    await click(first.page, 'Hold');
    const held = await daemon.until((status) => status.state === 'Hold' && status.rests);
    await first.page.getByText('On hold', { exact: true }).waitFor();
    await click(first.page, 'Increase: Feed');
    await click(first.page, 'Increase: Feed');
    await daemon.until((status) => Math.abs(status.overrides.feed - 1.2) < 1e-6);
    // The page is closed: the machine goes on holding, and another page finds it so.
    await first.context.close();
    const second = await visit(browser, daemon, 'run');
    expect(await second.page.getByTestId('state').innerText()).toBe('On hold');
    for (const [axis, place] of Object.entries((await daemon.status()).place)) expect(place).toBeCloseTo(held.place[axis] ?? NaN, 1.5);
    await second.page.locator('.owner').waitFor();
    await takeOver(second.page);
    for (let presses = 0; presses < 8; ++presses) await click(second.page, 'Increase: Feed');
    await click(second.page, 'Resume');
    await daemon.until((status) => status.state === 'Run');
    await daemon.until((status) => status.job?.state === 'done');
    await expect.poll(() => second.page.getByTestId('state').innerText()).toBe('Ready');
    expect(second.errors).toEqual([]);
    await second.context.close();
  });

  it('has one owner among two browsers', async () => {
    const one = await visit(browser, daemon, 'jog');
    const other = await visit(browser, daemon, 'jog');
    await takeOver(one.page);
    await one.page.getByRole('radio', { name: '1', exact: true }).check();
    const from = (await daemon.status()).place.x ?? NaN;
    await click(one.page, 'Jog X+');
    await other.page.locator('.owner').waitFor();
    expect(await other.page.locator('.owner').innerText()).toContain('Chromium on Linux is in control');
    const pad = other.page.getByRole('button', { name: 'Jog X+', exact: true });
    expect(await pad.getAttribute('aria-disabled')).toBe('true');
    expect(await pad.getAttribute('title')).toContain('Another client');
    const before = (await daemon.until((status) => status.state === 'Idle' && Math.abs((status.place.x ?? NaN) - from - 1) < 0.01)).place;
    await pad.click({ force: true });
    await sleep(300);
    expect((await daemon.status()).place).toEqual(before);
    // Everybody may stop.
    await one.page.getByRole('radio', { name: 'Continuous' }).check();
    await one.page.getByRole('button', { name: 'Jog X−', exact: true }).hover();
    // On a busy computer the lease may end before the other page can stop: then again.
    let stopped = false;
    for (let tries = 0; tries < 20 && !stopped; ++tries) {
      await one.page.mouse.down();
      const jogs = await daemon.until((status) => status.state === 'Jog', 3000).catch(() => null);
      const stop = other.page.getByRole('button', { name: 'Stop', exact: true }).first();
      stopped = jogs !== null && (await stop.click({ timeout: 2000 }).then(() => true, () => false));
      await daemon.until((status) => status.state === 'Idle');
      await one.page.mouse.up();
      await sleep(300);
    }
    expect(stopped).toBe(true);
    await one.context.close();
    await other.context.close();
  });
});

describe('Run beside an owner elsewhere', () => {
  it('is seen as a whole on a laptop, in each language', async () => {
    const { key } = (await daemon.post('/owner', '{"name": "a tablet beside the mill"}')) as { key: string };
    await daemon.post('/programs?name=wide.ngc', 'G21 G90\nG1 X10 F300\nM2\n');
    for (const language of ['en', 'it', 'fr', 'zh']) {
      const { page, context } = await visit(browser, daemon, 'run', { language, size: { width: 1366, height: 768 } });
      await page.locator('.owner').waitFor();
      await page.locator('.text-line code span').first().waitFor({ state: 'attached' });
      const over = await page.evaluate(() => {
        const content = document.querySelector('.content');
        const foot = document.querySelector('.position-foot');
        const lines = (foot?.getBoundingClientRect().height ?? 0) / parseFloat(getComputedStyle(document.documentElement).fontSize);
        return [(content?.scrollHeight ?? 0) - (content?.clientHeight ?? 0), (content?.scrollWidth ?? 0) - (content?.clientWidth ?? 0), Math.floor(lines / 2.5)];
      });
      expect(over, language).toEqual([0, 0, 0]);
      await context.close();
    }
    await fetch(`${daemon.address}api/v1/owner`, { method: 'DELETE', headers: { 'X-Passo-Key': key } });
  });
});

describe('a dialog that is open while the machine moves', () => {
  it('has hold and stop, and the space bar holds', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files');
    await takeOver(page);
    await send(page, 'slow.ngc', 'G21 G91 G1 F100 X20\nX-20\nM2\n');
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await startProgram(page);
    await daemon.until((status) => status.state === 'Run');
    await page.keyboard.press('?');
    await page.keyboard.press('Space');
    await daemon.until((status) => status.state === 'Hold' && status.rests);
    await page.getByRole('dialog').getByRole('button', { name: 'Hold' }).waitFor({ state: 'detached' });
    await page.getByRole('dialog').getByRole('button', { name: 'Close' }).click();
    await click(page, 'Resume');
    await daemon.until((status) => status.state === 'Run');
    await click(page, 'Settings');
    expect(await violations(page)).toEqual([]);
    await page.getByRole('dialog').getByRole('button', { name: 'Stop' }).click();
    await daemon.until((status) => status.state === 'Idle' && status.job?.state === 'stopped');
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('a program line by line', () => {
  it('rests after each line, passes M1, waits at M0 for Done, and leaves out lines with /', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files');
    await takeOver(page);
    await send(page, 'lines.ngc', 'G21 G91\nG1 F3000 X5\n/X50\nM1\nX5\nM0\nX-10\nM2\n');
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await click(page, 'Block delete: skip lines that start with / (1)');
    await page.getByRole('button', { name: 'Block delete: skip lines that start with / (1)', pressed: true }).waitFor();
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await page.goto(`${daemon.address}#/run`);
    await click(page, 'Single block');
    await click(page, 'Stop at M1');
    await daemon.until((status) => status.stops.single_block && !status.stops.optional_stop);
    const at = (await daemon.status()).place.x ?? 0;
    await startProgram(page);
    for (const way of [5, 10]) {
      await daemon.until((status) => status.rests && status.holds.includes('line-end') && Math.abs((status.place.x ?? 0) - at - way) < 0.01);
      await page.getByText('Line finished').waitFor();
      await click(page, 'Resume');
    }
    await page.getByText('Waiting for the operator').waitFor();
    await click(page, 'Single block');
    await daemon.until((status) => !status.stops.single_block);
    await click(page, 'Done');
    await daemon.until((status) => status.job?.state === 'done' && Math.abs((status.place.x ?? 0) - at) < 0.01);
    await click(page, 'Stop at M1');
    await daemon.until((status) => status.stops.optional_stop);
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('a program that waits for a person', () => {
  it('is told by its own words, and leads to the jog, the zeros and the probe, and on', async () => {
    const waits = { for: 'M6', line: 12, tool: 5, message: 'Turn the plate over\n6 mm drill', free: true };
    for (const [language, line, done, jog] of [['en', 'M6, line 12, tool 5', 'Done', 'Setup'], ['fr', 'M6, ligne 12, outil 5', 'Fait', 'Réglage']] as const) {
      // What the daemon tells of a machine at M6.
      const before = (page: Page): Promise<void> =>
        page.routeWebSocket(/\/stream/, (socket) => {
          const server = socket.connectToServer();
          server.onMessage((said) => socket.send(JSON.stringify({ ...(JSON.parse(String(said)) as object), waits, state: 'Tool', owner: { kind: 'nobody', name: '', taken: 0 } })));
        });
      const { page, context, errors } = await visit(browser, daemon, 'run', { language, before });
      const banner = page.locator('.waits');
      await banner.getByText(line).waitFor();
      expect(await banner.locator('.program-words').innerText()).toBe(waits.message);
      expect(await banner.getByRole('button', { name: done }).getAttribute('aria-disabled')).toBe('false');
      expect(await page.locator('.act.go').innerText()).toContain(done);
      await banner.getByRole('button', { name: jog }).click();
      for (const button of ['.pad-button', '.set-up-buttons button', '.probing .button.accent']) {
        await expect.poll(() => page.locator(button).first().getAttribute('aria-disabled'), { message: button }).toBe('false');
      }
      expect(await violations(page)).toEqual([]);
      expect(errors).toEqual([]);
      await context.close();
    }
  });
});

describe('a jog by the keyboard', () => {
  let page: Page;
  let close: () => Promise<void>;
  beforeAll(async () => {
    const visited = await visit(browser, daemon, 'jog');
    page = visited.page;
    close = () => visited.context.close();
    await takeOver(page);
    await page.getByRole('radio', { name: 'Continuous' }).check();
    await page.locator('h2').first().click();
  });
  afterAll(() => close());

  afterEach(async () => {
    for (const key of ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown']) await page.keyboard.up(key);
    await page.evaluate(() => window.dispatchEvent(new Event('focus')));
  });

  // Holds a key for longer than the lease. On a busy computer a renewal may come too late, and the motion ends, as it
  // should: then again.
  const hold = async (key: string): Promise<void> => {
    await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
    for (let tries = 0; tries < 20; ++tries) {
      await daemon.until((status) => status.state === 'Idle');
      await page.keyboard.down(key);
      await daemon.until((status) => status.state === 'Jog', 3000).catch(() => undefined);
      await sleep(400);
      if ((await daemon.status()).state === 'Jog') return;
      await page.keyboard.up(key);
      await sleep(300);
    }
    throw new Error('no jog has lasted');
  };
  const hasStopped = async (): Promise<void> => {
    const status = await daemon.until((one) => one.state === 'Idle' && one.rests, 5000);
    await sleep(400);
    expect((await daemon.status()).place).toEqual(status.place);
  };

  it('stops when the key goes up', async () => {
    const before = (await daemon.status()).place.x ?? 0;
    await hold('ArrowRight');
    await page.keyboard.up('ArrowRight');
    await hasStopped();
    expect((await daemon.status()).place.x).toBeGreaterThan(before);
  });

  it('stops when the window loses the focus, and the key goes up elsewhere', async () => {
    await hold('ArrowRight');
    await page.evaluate(() => window.dispatchEvent(new Event('blur')));
    await hasStopped();
    await page.keyboard.up('ArrowRight');
    await page.evaluate(() => window.dispatchEvent(new Event('focus')));
  });

  it('stops when the tab is hidden', async () => {
    await hold('ArrowUp');
    await page.evaluate(() => {
      Object.defineProperty(document, 'hidden', { value: true, configurable: true });
      document.dispatchEvent(new Event('visibilitychange'));
    });
    await hasStopped();
    await page.keyboard.up('ArrowUp');
    await page.evaluate(() => {
      Object.defineProperty(document, 'hidden', { value: false, configurable: true });
      document.dispatchEvent(new Event('visibilitychange'));
    });
  });

  it('stops when the page freezes: nobody renews the lease', async () => {
    await hold('ArrowDown');
    const frozen = page.evaluate(() => {
      const end = performance.now() + 3000;
      while (performance.now() < end);
    });
    await daemon.until((status) => status.state === 'Idle', 3000);
    await frozen;
    await page.keyboard.up('ArrowDown');
    await hasStopped();
  });

  it('stops when the network is gone, and the page says so within 2 s', async () => {
    await hold('ArrowLeft');
    const network = await page.context().newCDPSession(page);
    await network.send('Network.enable');
    // Chromium's own switch leaves open WebSockets alone: so the daemon's voice is cut in the page.
    await page.evaluate(() => {
      const say = WebSocket.prototype.send;
      WebSocket.prototype.send = () => undefined;
      Object.assign(window, { mend: () => (WebSocket.prototype.send = say) });
    });
    await page.context().setOffline(true);
    await daemon.until((status) => status.state === 'Idle', 5000);
    await hasStopped();
    await page.keyboard.up('ArrowLeft');
    await page.evaluate(() => (window as unknown as { mend: () => void }).mend());
    await page.context().setOffline(false);
  });
});

describe('a lost daemon', () => {
  it('is told within 2 s, everything is disabled, and the page comes back by itself', async () => {
    const own = await Daemon.start();
    const { page, context } = await visit(browser, own, 'run');
    const port = new URL(own.address).port;
    await own.end();
    const lost = page.getByRole('alert');
    await lost.waitFor({ timeout: 6000 });
    expect(await lost.innerText()).toContain('Connection lost');
    for (const name of ['Start', 'Hold', 'Stop']) {
      const button = page.getByRole('button', { name }).first();
      expect(await button.getAttribute('aria-disabled')).toBe('true');
      expect(await button.getAttribute('title')).toContain('connection');
    }
    const again = await Daemon.start({ port });
    await lost.waitFor({ state: 'detached' });
    await context.close();
    await again.end();
  });
});

describe('a wrong program', () => {
  it('is refused with its lines, and cannot be started', async () => {
    const { page, context } = await visit(browser, daemon, 'files');
    await takeOver(page);
    await send(page, 'wrong.ngc', 'G21 G90\nG1 X10 F300\nG1 X9000\n');
    await expect.poll(() => page.getByTestId('verdict').innerText()).toContain('Has errors');
    await page.getByRole('button', { name: /Line 3/ }).first().waitFor();
    const start = page.getByRole('button', { name: 'Start' }).first();
    expect(await start.getAttribute('title')).toContain('errors');
    await page.getByRole('button', { name: /Line 3/ }).first().click();
    await page.locator('.text-line.picked').waitFor();
    await context.close();
  });
});

describe('what the daemon says', () => {
  it('is in the language of the page: what a check finds, and why something is refused', async () => {
    const { page, context } = await visit(browser, daemon, 'files', { language: 'fr' });
    await send(page, 'faux.ngc', 'G21 G90\nG1 X10\nG1 X9000 F300\nM2\n');
    await page.getByText('aucune avance n’est donnée').waitFor();
    await page.getByText('au-delà de sa limite de course').waitFor();
    await page.goto(`${daemon.address}#/console`);
    await page.getByRole('textbox', { name: 'Une ligne de G-code' }).fill('G2 X10');
    await page.keyboard.press('Enter');
    await page.locator('.notice', { hasText: 'un arc sans centre ni rayon' }).waitFor();
    await context.close();
    await rest();
  });
});

describe('every page', () => {

  it('speaks four languages, and is fit for everybody', async () => {
    for (const [language, words] of [['en', 'Ready'], ['it', 'Pronta'], ['fr', 'Prête'], ['zh', '就绪']] as const) {
      const theme = language === 'it' || language === 'zh' ? 'light' : 'dark';
      const size = language === 'fr' || language === 'zh' ? { width: 360, height: 740 } : { width: 1440, height: 900 };
      const { page, context, errors } = await visit(browser, daemon, 'run', { language, theme, size });
      await expect.poll(() => page.getByTestId('state').innerText()).toBe(words);
      for (const path of ['run', 'jog', 'files', 'cam', 'console', 'pins', 'machine', 'machine?part=board', 'lab']) {
        await page.goto(`${daemon.address}#/${path}`);
        await page.locator(`main.page-${path} :is(section, form, .panel)`).first().waitFor();
        expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${path} is too wide`).toBe(true);
        expect(await violations(page), `${path} in ${language}`).toEqual([]);
      }
      expect(errors).toEqual([]);
      await context.close();
    }
    await rest();
  });
});
