// Pictures of each page, in both themes and two sizes: scripts/page_pictures.sh FOLDER
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Daemon, example, openBrowser, sleep, visit } from './kit';

const folder = process.argv[2] ?? 'pictures';
const pages = process.argv[3]?.split(',') ?? ['run', 'jog', 'probe', 'files', 'cam', 'job', 'console', 'pins', 'machine', 'lab'];
const patience = 120_000; // ms, on a busy computer
const sizes = [
  { name: 'wide', width: 1440, height: 900 },
  { name: 'phone', width: 360, height: 740 },
] as const;

const text = readFileSync(example('engrave.ngc'), 'utf8');

async function prepare(daemon: Daemon): Promise<void> {
  const { key } = (await daemon.post('/owner', '{"name": "desk"}')) as { key: string };
  await daemon.post('/queue?name=bracket.ngc', text);
  await daemon.post('/programs?name=wrong.ngc', 'G21 G90\nG1 X10 F300\nG1 X9000\nG2 X1 Y1\n');
  const { id } = (await daemon.post('/programs?name=engrave.ngc', text)) as { id: number };
  await daemon.post('/work', '{"place": {"x": -12.5, "y": -8, "z": 2}}', key);
  await daemon.post(`/programs/${id - 1}/check`, '');
  await sleep(500);
  await daemon.post(`/programs/${id}/check`, '');
  await sleep(1500);
  await fetch(`${daemon.address}api/v1/owner`, { method: 'DELETE', headers: { 'X-Passo-Key': key } });
}

// The program that is open: the newest one, unless somebody has chosen.
async function choose(page: import('playwright-core').Page, daemon: Daemon, name: string): Promise<void> {
  await page.goto(`${daemon.address}#/files`);
  await page.locator('.file-row', { hasText: name }).click();
  await page.mouse.move(0, 0);
}

async function startFrom(page: import('playwright-core').Page, daemon: Daemon): Promise<void> {
  await page.getByRole('button', { name: 'Start', exact: true }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'Start' }).click();
  // The program begins with a tool change.
  await daemon.until((status) => status.state === 'Tool', 60_000);
  await page.getByRole('region', { name: 'Waiting for the operator' }).getByRole('button', { name: 'Done' }).click();
  await daemon.until((status) => status.state === 'Run' && status.progress !== null && status.progress > 0.25, 60_000);
}

// The holes of an example board.
async function cam(page: import('playwright-core').Page): Promise<void> {
  const known = page.getByRole('checkbox', { name: 'timer.drl' });
  if ((await known.count()) === 0) await page.setInputFiles('input[type=file]', example('boards/timer.drl'));
  else await known.check();
  await page.locator('.cam-result img').waitFor({ timeout: patience });
  await sleep(300);
}

// The work steps of a whole board.
async function board(browser: import('playwright-core').Browser, daemon: Daemon): Promise<void> {
  const { page, context } = await visit(browser, daemon, 'cam', { theme: 'light', size: { width: 1440, height: 900 } });
  await page.getByRole('radio', { name: 'Complete circuit board' }).check({ force: true });
  await page.setInputFiles('input[type=file]', ['timer-B_Cu.gbr', 'timer-Edge_Cuts.gbr', 'timer.drl'].map((name) => example(`boards/${name}`)));
  await page.getByRole('heading', { name: 'Work steps' }).waitFor({ timeout: patience });
  for (const picture of await page.locator('.board-step img').all()) await picture.evaluate((one) => one.setAttribute('loading', 'eager'));
  await sleep(2500);
  await page.screenshot({ path: join(folder, 'page-board.png'), timeout: patience });
  await context.close();
}

// The operations of a job file, beside its drawing.
async function jobFile(browser: import('playwright-core').Browser, daemon: Daemon, name: string, theme: 'light' | 'dark', size: { width: number; height: number }): Promise<void> {
  const { page, context } = await visit(browser, daemon, 'cam', { theme, size });
  await page.setInputFiles('input[type=file]', ['plate.svg', 'plate.toml'].map((one) => example(`jobs/${one}`)));
  await page.getByTestId('job-figures').nth(3).waitFor({ timeout: patience });
  await page.getByRole('button', { name: /^2\. Pocket/ }).click();
  await page.mouse.move(0, 0);
  await sleep(300);
  await page.screenshot({ path: join(folder, name), timeout: patience, fullPage: true });
  await context.close();
}

// A strip of single pulses, while a program runs.
async function pulses(page: import('playwright-core').Page, daemon: Daemon): Promise<void> {
  await page.goto(`${daemon.address}#/pins`);
  const strip = page.getByRole('region', { name: 'Single pulses' });
  await strip.getByText('after the previous pulse').waitFor({ timeout: patience });
  await strip.getByRole('button', { name: 'Zoom in' }).click();
  await sleep(1500);
  await strip.screenshot({ path: join(folder, 'page-pulses.png'), timeout: patience });
}

// The first board in the lab, while a clock turns two motors.
async function firstBoard(page: import('playwright-core').Page, daemon: Daemon): Promise<void> {
  await page.goto(`${daemon.address}#/lab?part=board&mode=automatic&axes=xy&run=1`);
  await page.locator('.lab-mode[data-mode=automatic]').waitFor({ timeout: patience });
  await sleep(3000);
  // Its front, motors, port and control window, as if the window were high enough.
  await page.setViewportSize({ width: 1440, height: 2400 });
  const part = await page.locator('.lab-bench').boundingBox();
  const below = await page.locator('.lab-bench .lab-halves').last().boundingBox();
  if (part === null || below === null) throw new Error('the first board is not on the page');
  const clip = { ...part, height: below.y - part.y };
  await page.screenshot({ path: join(folder, 'page-lab-board.png'), clip, timeout: patience });
  await page.setViewportSize(sizes[0]);
}

// Some lines of a person, and what came of them.
async function typeLines(page: import('playwright-core').Page, daemon: Daemon): Promise<void> {
  const field = page.getByPlaceholder('A line of G-code');
  for (const line of ['G91', 'G0 Z-1', 'G0 Z1', '$G', 'M3 S12000', 'M5', 'G90']) {
    await field.fill(line);
    await page.keyboard.press('Enter');
    await sleep(300);
    await daemon.until(({ state }) => state === 'Idle' || state === 'Line');
  }
}

// A probing cycle, and the height map of the program that is open.
async function probe(page: import('playwright-core').Page, daemon: Daemon): Promise<void> {
  const { programs } = await daemon.get<{ programs: { id: number }[] }>('/programs');
  const map = [0, 20, 40, 60].flatMap((y) => [0, 25, 50, 75, 100].map((x) => `${x},${y},${(0.002 * x - 0.003 * y + 0.06 * Math.sin(x / 20)).toFixed(4)}`));
  await daemon.post(`/programs/${programs.at(-1)?.id}/height-map`, `${map.join('\n')}\n`);
  // The page looks for a map when it comes.
  await page.goto(`${daemon.address}#/console`);
  await sleep(300);
  await page.goto(`${daemon.address}#/jog`);
  await page.getByRole('radio', { name: 'Corner', exact: true }).check({ force: true });
  await page.getByTestId('height-map').waitFor({ timeout: patience });
  await page.locator('.probing').scrollIntoViewIfNeeded();
  await page.evaluate(() => document.querySelector('.probing')?.scrollIntoView({ block: 'start' }));
  await sleep(300);
}

// The four pictures of a page on one sheet, for the documentation.
async function sheets(browser: import('playwright-core').Browser): Promise<void> {
  const page = await browser.newPage({ viewport: { width: 1600, height: 1000 } });
  const names = readdirSync(folder).flatMap((name) => /^(\w+)-dark-wide\.png$/.exec(name)?.[1] ?? []);
  for (const name of names) {
    const image = (theme: string, size: string): string => {
      const file = join(folder, `${name}-${theme}-${size}.png`);
      return existsSync(file) ? `<img class="${size}" src="data:image/png;base64,${readFileSync(file, 'base64')}">` : '';
    };
    const four = ['dark', 'light'].map((theme) => `<div>${image(theme, 'wide')}${image(theme, 'phone')}</div>`).join('');
    await page.setContent(
      `<style>body{margin:0;background:#808a94;width:1100px}div{display:flex;gap:12px;padding:8px 12px}.wide{height:512px}.phone{height:512px}</style>${four}`,
    );
    await page.locator('body').screenshot({ path: join(folder, `page-${name}.jpg`), type: 'jpeg', quality: 82, timeout: patience });
  }
  await page.close();
  for (const [one, name] of [['running-dark-wide', 'page-run'], ['probe-dark-wide', 'page-probe']] as const) {
    if (existsSync(join(folder, `${one}.png`))) copyFileSync(join(folder, `${one}.png`), join(folder, `${name}.png`));
  }
}

mkdirSync(folder, { recursive: true });
const browser = await openBrowser();

// A job under way, on a machine whose file describes no motors: the one of the other pictures loses steps in it.
async function running(theme: 'dark' | 'light', size: (typeof sizes)[number], density: number): Promise<void> {
  const daemon = await Daemon.start({ machine: example('machines/router.toml') });
  await prepare(daemon);
  const { page, context } = await visit(browser, daemon, 'run', { theme, size, density });
  await choose(page, daemon, 'engrave.ngc');
  await page.goto(`${daemon.address}#/run`);
  await page.locator('.scene:not([data-shown=""])').waitFor({ timeout: patience });
  await page.getByRole('button', { name: 'Stock', exact: true }).click();
  await startFrom(page, daemon);
  await sleep(300);
  await page.screenshot({ path: join(folder, `running-${theme}-${size.name}.png`), timeout: patience });
  if (theme === 'dark') await pulses(page, daemon);
  await fetch(`${daemon.address}api/v1/stop`, { method: 'POST' });
  await daemon.until((status) => status.state === 'Idle');
  await context.close();
  await daemon.end();
}
for (const theme of ['dark', 'light'] as const) {
  const daemon = await Daemon.start({ machine: example('machines/strong-router.toml') });
  await prepare(daemon);
  for (const size of sizes) {
    const density = size.name === 'phone' ? 2 : 1;
    const { page, context } = await visit(browser, daemon, pages[0] ?? 'run', { theme, size, density });
    for (const path of pages.filter((one) => one !== 'job')) {
      if (path === 'run' || path === 'files') await choose(page, daemon, 'engrave.ngc');
      await page.goto(`${daemon.address}#/${path === 'probe' ? 'jog' : path}`);
      await sleep(900);
      if (path === 'cam') await cam(page);
      if (path === 'console') await typeLines(page, daemon);
      if (path === 'probe') await probe(page, daemon);
      if (path === 'files') await page.getByTestId('torque').getByText('%').waitFor({ timeout: patience });
      if (path === 'run') {
        await page.locator('.scene:not([data-shown=""])').waitFor({ timeout: patience });
        await page.getByRole('button', { name: 'Stock', exact: true }).click();
        await page.locator('.text-line code span').first().waitFor({ state: 'attached', timeout: patience });
        await sleep(500);
      }
      await page.locator('.frame:not(.not-live)').waitFor({ timeout: patience });
      await page.screenshot({ path: join(folder, `${path}-${theme}-${size.name}.png`), timeout: patience });
    }
    if (size.name === 'wide' && theme === 'dark' && pages.includes('lab')) await firstBoard(page, daemon);
    if (size.name === 'wide' && pages.includes('run')) await running(theme, size, density);
    await page.goto('about:blank'); // a page that is left gives the motion back
    await sleep(300);
    await context.close();
  }
  if (theme === 'light' && pages.includes('cam')) await board(browser, daemon);
  if (theme === 'light' && pages.includes('job')) await jobFile(browser, daemon, 'page-job.png', 'light', { width: 1440, height: 1300 });
  if (theme === 'dark' && pages.includes('job')) await jobFile(browser, daemon, 'page-job-phone.png', 'dark', { width: 360, height: 740 });
  await daemon.end();
}
await sheets(browser);
await browser.close();
