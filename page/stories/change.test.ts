// A tool change that measures, from the page: M6 asks, the operator confirms, the tool touches off, its length is shown, and
// the job continues.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Daemon, example, openBrowser, violations, visit } from './kit';

let browser: Browser;
let daemon: Daemon;
let folder: string;
// Short ways. A tool touches at Z-20, the nose would at Z-45: each tool is 25 mm long.
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'passo-story-'));
  const changes: [RegExp, string][] = [
    [/change_at_mm = .*/, 'change_at_mm = [20, -20]'],
    [/measure_at_mm = .*/, 'measure_at_mm = [40, -20]'],
    [/safe_z_mm = .*/, 'safe_z_mm = 5'],
    [/window_mm = .*/, 'window_mm = [-40, 0]'],
    [/lengths = .*/, 'lengths = "absolute"\nnose_z_mm = -45'],
    [/seek_mm_s = .*/, 'seek_mm_s = 40'],
    [/wear_mm = .*/, ''],
    [/spindle_run_down_s = .*/, 'spindle_run_down_s = 0.2'],
  ];
  const machine = join(folder, 'setter.toml');
  writeFileSync(machine, changes.reduce((text, [was, is]) => text.replace(was, is), readFileSync(example('machines/tool-setter.toml'), 'utf8')));
  browser = await openBrowser();
  daemon = await Daemon.start({ machine, touch: ['X38:42,Z:-20'] });
});
afterAll(async () => {
  await browser?.close();
  await daemon?.end();
  rmSync(folder, { recursive: true, force: true });
});

const pictures = process.env.PASSO_CHANGE_PICTURES; // a folder, for whoever wants to look
const look = async (page: Page, name: string): Promise<void> => {
  if (pictures !== undefined) await page.screenshot({ path: `${pictures}/${name}.png` });
};
const program = 'G21 G90\n(end mill, 6 mm)\nT1 M6\nM3 S1000\nG0 X30 Z-24\nG1 X34 F600\nG0 Z-20\n(V bit)\nT2 M6\nG0 X34 Z-23\nG1 X20 F600\nM2\n';

describe('a tool change that measures', () => {
  it('asks on the page, touches off, shows the length, and the job continues', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files', { size: { width: 1280, height: 900 } });
    await page.setInputFiles('input[type=file]', { name: 'two-tools.ngc', mimeType: 'text/plain', buffer: Buffer.from(program) });
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings)/);
    await page.goto(`${daemon.address}#/run`);
    expect(await page.getByTestId('measured-tool').count()).toBe(0);
    await page.getByRole('button', { name: 'Start', exact: true }).first().click();
    await page.getByRole('dialog').getByRole('button', { name: 'Start', exact: true }).click();
    const banner = page.locator('.waits');
    for (const [line, tool] of [[3, 1], [9, 2]] as const) {
      await banner.getByText(`M6, line ${line}, tool ${tool}`).waitFor();
      expect(await banner.locator('.program-words').innerText()).toContain(`put tool ${tool} into the spindle`);
      const at = await daemon.status();
      // The program's own Z: a tool of 25 mm is in the spindle already when the second one is asked for.
      await expect.poll(() => page.getByTestId('work-z').innerText()).toBe(tool === 1 ? '5.000' : '-20.000');
      expect(at.outputs.spindle).toBe('off');
      expect([at.place.x, at.place.y, at.place.z]).toEqual([expect.closeTo(20, 2), expect.closeTo(-20, 2), expect.closeTo(5, 2)]);
      await look(page, `asks-${tool}`);
      if (tool === 1) expect(await violations(page)).toEqual([]);
      await banner.getByRole('button', { name: 'Done' }).click();
      await expect.poll(() => page.getByTestId('measured-tool').innerText()).toContain(`Length of tool ${tool}`);
      expect(await page.getByTestId('measured-tool').innerText()).toContain('25.0');
      expect(await page.getByTestId('measured-tool').getByText('Length of tool').isVisible()).toBe(true);
      expect(await page.locator('.position').evaluate((one) => one.scrollWidth - one.clientWidth), 'the panel holds all of it').toBeLessThanOrEqual(0);
      await look(page, `length-${tool}`);
    }
    const ended = await daemon.until((status) => status.job?.state === 'done' && status.state === 'Idle');
    expect(ended.place.x).toBeCloseTo(20, 2);
    expect(ended.place.z).toBeCloseTo(-23 + 25, 1);
    expect(errors).toEqual([]);
    await context.close();
  });
});
