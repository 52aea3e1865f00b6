// What a person prepares: places found by the probe, a height map, the torque, the stock, limits for the motors, letters.
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Daemon, example, MjpegCamera, openBrowser, violations, visit } from './kit';

let browser: Browser;
let daemon: Daemon;
let folder: string;
let camera: MjpegCamera;
const pictures = process.env.PASSO_WORK_PICTURES; // a folder, for whoever wants to look
const look = async (page: Page, name: string): Promise<void> => {
  if (pictures !== undefined) await page.screenshot({ path: `${pictures}/${name}.png` });
};
// A sheet with a bright dot beside its middle.
async function cameraPicture(): Promise<Buffer> {
  const page = await browser.newPage({ viewport: { width: 640, height: 480 } });
  await page.setContent('<body style="margin:0;background:#567"><div style="position:absolute;left:150px;top:120px;width:340px;height:240px;background:#b98"></div><div style="position:absolute;left:330px;top:210px;width:40px;height:40px;border-radius:50%;background:#ffd"></div></body>');
  const jpeg = await page.screenshot({ type: 'jpeg', quality: 70 });
  await page.close();
  return jpeg;
}
const patience = 60_000; // ms, on a busy computer; what runs at a low priority gets more
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'passo-story-'));
  const machine = join(folder, 'machine.toml');
  browser = await openBrowser();
  camera = await MjpegCamera.start(await cameraPicture());
  const more = `[park]\nplace_mm = [-30, 40]\n[camera]\nurl = "${camera.url}"\noffset_mm = [20, -15]\n`;
  writeFileSync(machine, `${readFileSync(example('machines/strong-router.toml'), 'utf8')}\n${more}`);
  const macros = join(folder, 'macros');
  mkdirSync(macros);
  writeFileSync(join(macros, 'aside.ngc'), '; title = "Move aside"\n; key = "F6"\n; [value.way]\n; title = "Distance"\n; unit = "mm"\n; least = 1\n; most = 50\nG21 G91 G0 X#<way>\n');
  // A block whose corner is 8 and 9 mm beside the probe, its top 11.2 mm below.
  daemon = await Daemon.start({ machine, touch: ['X-8:90,Y-9:70,Z-50:-11.2'], macros });
});
afterAll(async () => {
  await browser?.close();
  await daemon?.end();
  camera?.end();
  rmSync(folder, { recursive: true, force: true });
});

const part = 'G21 G90 G17\nF1200\nG0 Z5\nG0 X10 Y10\nG1 Z-1\nG1 X40\nG1 Y30\nG1 X10\nG1 Y10\nG0 Z5\nM2\n';
const choose = (page: Page, name: string): Promise<void> => page.getByRole('radio', { name, exact: true }).check();
const enter = async (page: Page, name: RegExp, value: string): Promise<void> => {
  const field = page.locator('.probing').getByRole('textbox', { name });
  await field.fill(value);
  await field.blur();
};
const agree = (page: Page, name: string): Promise<void> => page.getByRole('dialog').getByRole('button', { name, exact: true }).click();

describe('the probe', () => {
  it('finds a corner after a question with all facts, and a height map levels a program', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files');
    page.setDefaultTimeout(patience);
    await page.setInputFiles('input[type=file]', { name: 'part.ngc', mimeType: 'text/plain', buffer: Buffer.from(part) });
    await expect.poll(() => page.getByTestId('verdict').innerText(), { timeout: patience }).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await page.goto(`${daemon.address}#/jog`);
    await choose(page, 'Corner');
    await choose(page, 'front left');
    expect(await page.getByTestId('cycle-steps').innerText()).toContain('out beyond the edge by 25 mm');
    expect(await violations(page)).toEqual([]);
    await page.getByRole('button', { name: 'Probe …' }).click();
    const question = page.getByRole('dialog');
    expect(await question.innerText()).toContain('Sets X0, Y0 and Z0.');
    expect(await question.innerText()).toContain('nothing is set');
    await agree(page, 'Probe');
    const found = await daemon.until((status) => status.job?.name === 'probe corner' && status.job.state === 'done', patience * 2);
    expect(found.work_offset?.x).toBeCloseTo(-8, 1);
    expect(found.work_offset?.y).toBeCloseTo(-9, 1);
    expect(found.work_offset?.z).toBeCloseTo(-11.2, 1);
    await expect.poll(() => page.getByTestId('state').innerText(), { timeout: patience }).toBe('Ready');
    await choose(page, 'Height map');
    for (const [name, value] of [[/^Points in X/, '3'], [/^Points in Y/, '2'], [/^Width in X/, '40'], [/^Width in Y/, '30']] as const) {
      await enter(page, name, value);
    }
    await page.getByRole('button', { name: 'Probe …' }).click();
    expect(await question.innerText()).toContain('The map is for part.ngc.');
    await agree(page, 'Probe');
    await page.getByTestId('height-map').waitFor({ timeout: patience * 2 });
    expect(await page.getByTestId('height-map').innerText()).toContain('3 × 2 points');
    await daemon.until((status) => status.state === 'Idle', patience);
    await page.getByRole('button', { name: 'Apply the height map' }).click();
    await expect.poll(async () => (await daemon.get<{ programs: unknown[] }>('/programs')).programs.length, { timeout: patience }).toBeGreaterThan(3);
    expect(errors).toEqual([]);
    await context.close();
  });

  it('says in a question, in each language, that nobody may be near, and asks for nothing impossible', async () => {
    const { page, context } = await visit(browser, daemon, 'jog', { language: 'it' });
    await choose(page, 'Foro');
    await enter(page, /^Corsa/, '99999');
    expect(await page.locator('.probing').getByRole('textbox', { name: /^Corsa/ }).inputValue()).toBe('1000');
    expect(await page.locator('.probing').innerText()).toContain('Imposta X0 e Y0.');
    await context.close();
  });
});

describe('the torque of the motors', () => {
  it('is told in Files and shown on the path, and the stock is seen as it is cut', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files');
    page.setDefaultTimeout(patience);
    await page.setInputFiles('input[type=file]', { name: 'torque.ngc', mimeType: 'text/plain', buffer: Buffer.from(part) });
    await expect.poll(() => page.getByTestId('torque').innerText(), { timeout: patience * 4 }).toMatch(/\d %/);
    await page.getByRole('button', { name: 'Show on the toolpath' }).click();
    await page.locator('.scene-legend').getByText('of the guaranteed torque').waitFor();
    const scene = page.locator('.scene canvas');
    const before = await scene.screenshot();
    await page.getByRole('button', { name: 'Stock', exact: true }).click();
    await expect.poll(async () => (await scene.screenshot()).equals(before), { timeout: patience }).toBe(false);
    await page.getByRole('group', { name: 'Tool that cuts the stock' }).waitFor();
    expect(await violations(page)).toEqual([]);
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('limits for the motors', () => {
  it('are proposed with their curves, and taken into the table', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'machine');
    page.setDefaultTimeout(patience);
    await page.getByTestId('scale-X').waitFor();
    await page.getByRole('button', { name: 'Calculate the limits' }).click();
    await page.getByTestId('tuned').waitFor({ timeout: patience * 3 });
    const curves = page.getByRole('img', { name: /^Torque curve of each motor/ });
    await expect.poll(() => curves.evaluate((one) => (one as HTMLImageElement).naturalWidth), { timeout: patience }).toBeGreaterThan(0);
    const speed = page.getByRole('textbox', { name: 'X Maximum speed' });
    const was = await speed.inputValue();
    await page.getByRole('button', { name: 'Use these limits …' }).click();
    await agree(page, 'Use these limits');
    await expect.poll(() => speed.inputValue(), { timeout: patience }).not.toBe(was);
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => speed.inputValue(), { timeout: patience }).toBe(was);
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('CAM', () => {
  it('engraves letters, and a drawing that is dropped in Files is cleared as a pocket', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'cam');
    page.setDefaultTimeout(patience);
    await choose(page, 'Engrave');
    const letters = page.getByRole('textbox', { name: 'Text instead of a drawing' });
    await letters.pressSequentially('No. 7');
    expect(await letters.inputValue()).toBe('No. 7');
    await expect.poll(() => page.getByTestId('cam-state').innerText(), { timeout: patience * 4 }).toBe('Generated');
    await page.locator('.cam-result img').waitFor();
    await page.goto(`${daemon.address}#/files`);
    const drawing = '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30"><rect x="5" y="5" width="30" height="20"/></svg>';
    await page.setInputFiles('input[type=file]', { name: 'tray.svg', mimeType: 'image/svg+xml', buffer: Buffer.from(drawing) });
    await page.getByRole('checkbox', { name: 'tray.svg' }).waitFor();
    await choose(page, 'Pocket');
    const made = async (): Promise<string> => JSON.stringify(await daemon.get('/programs'));
    await expect.poll(made, { timeout: patience * 4 }).toContain('tray-pocket.ngc');
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('at the press of a button', () => {
  it('the machine frames a job, parks, and runs a macro with its values', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files');
    page.setDefaultTimeout(patience);
    const ends = (name: string) => daemon.until((status) => status.job?.name === name && status.job.state === 'done', patience * 2);
    await page.setInputFiles('input[type=file]', { name: 'framed.ngc', mimeType: 'text/plain', buffer: Buffer.from(part) });
    await expect.poll(() => page.getByTestId('verdict').innerText(), { timeout: patience }).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await page.goto(`${daemon.address}#/run`);
    await page.getByRole('button', { name: 'Frame …' }).click();
    const question = page.getByRole('dialog');
    expect(await question.innerText()).toContain('with the spindle off');
    const height = question.getByRole('textbox', { name: /^Height/ });
    await height.fill('20000');
    await height.blur();
    expect(await question.getByRole('button', { name: /^Frame/ }).getAttribute('aria-disabled')).toBe('true');
    await height.fill('2');
    await height.blur();
    expect(await violations(page)).toEqual([]);
    await question.getByRole('radio', { name: 'Convex hull' }).check();
    await agree(page, 'Frame');
    const framed = await ends('frame framed.ngc');
    expect((framed.place.z ?? 0) - (framed.work_offset?.z ?? 0)).toBeCloseTo(5, 1);
    expect(await page.getByText('framed.ngc').first().isVisible(), 'the job is still shown').toBe(true);
    await page.goto(`${daemon.address}#/jog`);
    await page.getByRole('button', { name: 'Park', exact: true }).click();
    await agree(page, 'Go');
    const parked = await ends('go to park');
    expect([parked.place.x, parked.place.y]).toEqual([expect.closeTo(-30, 2), expect.closeTo(40, 2)]);
    await expect.poll(() => page.getByTestId('state').innerText(), { timeout: patience }).toBe('Ready');
    await page.keyboard.press('F6');
    expect(await violations(page)).toEqual([]);
    const run = page.getByRole('dialog').getByRole('button', { name: /^Run/ });
    expect(await run.getAttribute('aria-disabled'), 'a value is missing').toBe('true');
    const way = page.getByRole('dialog').getByRole('textbox', { name: /^Distance/ });
    await way.fill('12.5');
    await way.blur();
    await run.click();
    expect((await ends('macro aside')).place.x).toBeCloseTo(-17.5, 2);
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('the camera', () => {
  it('is seen beside the toolpath, and its cross-hair is where the zero is set and where the tool goes', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'run');
    page.setDefaultTimeout(patience);
    const picture = page.getByRole('img', { name: 'Picture of the camera' });
    const width = (): Promise<number> => picture.evaluate((one) => (one as HTMLImageElement).naturalWidth);
    await expect.poll(width, { timeout: patience }).toBe(640);
    await expect.poll(() => page.getByTestId('camera-state').innerText(), { timeout: patience }).toBe('');
    expect(await violations(page)).toEqual([]);
    await expect.poll(width, { timeout: patience }).toBe(640);
    await look(page, 'camera-run');
    await page.goto(`${daemon.address}#/jog`);
    await expect.poll(width, { timeout: patience }).toBe(640);
    const before = await daemon.status();
    await page.getByRole('button', { name: 'Zero X and Y at the cross-hair' }).click();
    expect(await page.getByRole('dialog').innerText()).toContain('The cross-hair is now at');
    await agree(page, 'Work zero');
    const zeroed = await daemon.until((status) => Math.abs((status.work_offset?.x ?? 0) - (before.place.x ?? 0) - 20) < 1e-3, patience);
    expect(zeroed.work_offset?.y).toBeCloseTo((before.place.y ?? 0) - 15, 3);
    expect(zeroed.work_offset?.z).toBe(before.work_offset?.z);
    await page.getByText('Find the offset of the camera').click();
    await page.getByRole('button', { name: 'Spindle is at the dot' }).click();
    await page.getByRole('button', { name: 'Move the tool to the cross-hair' }).click();
    await agree(page, 'Go');
    const moved = await daemon.until((status) => status.job?.name === 'go to the cross-hair' && status.job.state === 'done', patience * 2);
    expect([moved.place.x, moved.place.y]).toEqual([expect.closeTo((before.place.x ?? 0) + 20, 2), expect.closeTo((before.place.y ?? 0) - 15, 2)]);
    await expect.poll(() => page.getByTestId('camera-offset').innerText(), { timeout: patience }).toMatch(/X [-−]20\.000\s+Y 15\.000/);
    await page.getByRole('button', { name: '2×' }).click();
    expect(await violations(page)).toEqual([]);
    await look(page, 'camera-jog');
    // A job that is not a small one has its pictures in the history.
    const { key } = (await daemon.post('/owner', '{}')) as { key: string };
    const { id } = (await daemon.post('/programs?name=seen.ngc', 'G21 G90\nG1 X1 F3000\nM2\n')) as { id: number };
    await daemon.post(`/programs/${id}/run`, '', key);
    await daemon.until((status) => status.job?.name === 'seen.ngc' && status.job.state === 'done', patience);
    await page.goto(`${daemon.address}#/files`);
    const still = page.getByRole('img', { name: 'seen.ngc at the end' });
    await still.waitFor({ timeout: patience });
    await still.scrollIntoViewIfNeeded();
    await expect.poll(() => still.evaluate((one) => (one as HTMLImageElement).naturalWidth), { timeout: patience }).toBe(640);
    expect(await violations(page)).toEqual([]);
    await look(page, 'camera-files');
    // The camera vanishes: the page says so, and the machine works on.
    await page.goto(`${daemon.address}#/run`);
    await expect.poll(width, { timeout: patience }).toBe(640);
    camera.end();
    await expect.poll(() => page.getByTestId('camera-state').innerText(), { timeout: patience }).toMatch(/^No picture for \d+ s: the camera (cannot be reached|has closed the connection)/);
    await look(page, 'camera-gone');
    expect(errors).toEqual([]);
    await context.close();
  });
});
