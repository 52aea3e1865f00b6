// Pictures of each page, in both themes and two sizes: scripts/page_pictures.sh FOLDER
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Daemon, example, openBrowser, sleep, visit } from './kit';

const folder = process.argv[2] ?? 'pictures';
const pages = process.argv[3]?.split(',') ?? ['run', 'jog', 'files', 'make', 'console', 'pins', 'machine', 'lab'];
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

async function startFrom(page: import('playwright-core').Page, daemon: Daemon): Promise<void> {
  await page.getByRole('button', { name: 'Start', exact: true }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'Start' }).click();
  // The program begins with a tool change.
  await daemon.until((status) => status.state === 'Tool', 60_000);
  await page.getByRole('button', { name: 'Done', exact: true }).click();
  await daemon.until((status) => status.state === 'Run' && status.progress !== null && status.progress > 0.25, 60_000);
}

mkdirSync(folder, { recursive: true });
const browser = await openBrowser();
for (const theme of ['dark', 'light'] as const) {
  const daemon = await Daemon.start({ machine: example('machines/router.toml') });
  await prepare(daemon);
  for (const size of sizes) {
    const density = size.name === 'phone' ? 2 : 1;
    const { page, context } = await visit(browser, daemon, pages[0] ?? 'run', { theme, size, density });
    for (const path of pages) {
      await page.goto(`${daemon.address}#/${path}`);
      await sleep(900);
      await page.screenshot({ path: join(folder, `${path}-${theme}-${size.name}.png`) });
    }
    if (size.name === 'wide' && pages.includes('run')) {
      await page.goto(`${daemon.address}#/run`);
      await startFrom(page, daemon);
      await sleep(300);
      await page.screenshot({ path: join(folder, `running-${theme}-${size.name}.png`) });
      await fetch(`${daemon.address}api/v1/stop`, { method: 'POST' });
      await daemon.until((status) => status.state === 'Idle');
      await sleep(1500);
    }
    await context.close();
  }
  await daemon.end();
}
await browser.close();
