// The machine file in the editor, the pins and the outputs by hand, and a gamepad.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Daemon, openBrowser, smallMachine, violations, visit } from './kit';

let browser: Browser;
let daemon: Daemon;
let folder: string;
let machine: string;
beforeAll(async () => {
  browser = await openBrowser();
  folder = mkdtempSync(join(tmpdir(), 'passo-machine-'));
  machine = smallMachine(folder);
  daemon = await Daemon.start({ machine });
});
afterAll(async () => {
  await browser?.close();
  await daemon?.end();
  rmSync(folder, { recursive: true, force: true });
});

const click = (page: Page, name: string): Promise<void> => page.getByRole('button', { name, exact: true }).first().click();
const agree = (page: Page, name: string): Promise<void> => page.getByRole('dialog').getByRole('button', { name }).click();
const enter = async (page: Page, field: string, text: string): Promise<void> => {
  await page.getByRole('textbox', { name: field, exact: true }).fill(text);
  await page.keyboard.press('Tab');
};

describe('the machine file', () => {
  it('shows its arithmetic, refuses with the reason, goes back, and keeps comments', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'machine');
    const scale = page.getByTestId('scale-X');
    await expect.poll(() => scale.innerText()).toContain('200 × 16 ÷ 5 =');
    expect(await scale.innerText()).toContain('640');
    await enter(page, 'X Microsteps', '8');
    await expect.poll(() => scale.innerText()).toContain('320');
    // A wrong setting: the machine would rest beyond its travel.
    await enter(page, 'X Switch position', '500');
    const refusal = page.getByRole('alert');
    await refusal.waitFor();
    expect(await refusal.innerText()).toContain('machine.');
    const write = page.getByRole('button', { name: /^Save the file/ });
    expect(await write.getAttribute('aria-disabled')).toBe('true');
    await click(page, 'Undo');
    await refusal.waitFor({ state: 'detached' });
    // A conflict of pins: two axes with one motor.
    for (const [axis, motor] of [['X', '0'], ['Y', '0'], ['Z', '1']] as const) await enter(page, `${axis} Board motor`, motor);
    await refusal.waitFor();
    expect(await refusal.innerText()).toContain('motor');
    for (let steps = 0; steps < 3; ++steps) await click(page, 'Undo');
    await refusal.waitFor({ state: 'detached' });
    await click(page, 'Save the file');
    await page.getByRole('dialog').getByText('16 → 8').waitFor();
    await agree(page, 'Save the file');
    await page.getByText('Restart passo serve to apply it.').waitFor();
    expect(readFileSync(machine, 'utf8')).toContain('microsteps = 8              # as set on the driver');
    // Somebody else changes the file: it is not overwritten.
    await enter(page, 'X Microsteps', '4');
    writeFileSync(machine, `${readFileSync(machine, 'utf8')}# by hand\n`);
    await click(page, 'Save the file');
    await agree(page, 'Save the file');
    await page.getByText('another client changed the machine file').first().waitFor();
    await click(page, 'Reload');
    await expect.poll(() => scale.innerText()).toContain('320');
    expect(readFileSync(machine, 'utf8')).toContain('# by hand');
    expect(errors.filter((one) => !one.includes('Failed to load'))).toEqual([]);
    await context.close();
  });

  it('comes as TOML, and a text that is no machine is refused with its lines', async () => {
    const { page, context } = await visit(browser, daemon, 'machine');
    await page.getByTestId('scale-X').waitFor();
    await page.setInputFiles('input[type=file]', { name: 'x.toml', mimeType: 'text/plain', buffer: Buffer.from('name = "X"\nspeed = 3\n') });
    const refusal = page.getByRole('alert');
    await refusal.waitFor();
    expect(await refusal.innerText()).toContain('2: speed = 3');
    await click(page, 'Undo');
    await page.getByTestId('scale-X').waitFor();
    await context.close();
  });
});

describe('usual values of the work', () => {
  it('are written into the machine file, and count in CAM', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'machine', { language: 'it' });
    await page.getByTestId('scale-X').waitFor();
    await enter(page, 'Quota di sicurezza sopra il pezzo', '-7');
    // Refused, in the language of the page.
    await page.getByText('work.clearance_mm vale -7').waitFor();
    await enter(page, 'Quota di sicurezza sopra il pezzo', '7');
    await enter(page, 'Profondità di taglio', '-2,5');
    await click(page, 'Salva il file');
    await agree(page, 'Salva il file');
    await expect.poll(() => readFileSync(machine, 'utf8')).toContain('[work]\nclearance_mm = 7\ndepth_mm = -2.5');
    await page.goto(`${daemon.address}#/cam`);
    await page.getByRole('radio', { name: 'Foratura' }).check({ force: true });
    expect(await page.getByRole('textbox', { name: 'Quota di sicurezza' }).getAttribute('placeholder')).toBe('7mm');
    const holes = 'M48\nMETRIC\nT1C0.800\n%\nT1\nX10.0Y10.0\nM30\n';
    await page.setInputFiles('input[type=file]', { name: 'work.drl', mimeType: 'text/plain', buffer: Buffer.from(holes) });
    await expect.poll(async () => JSON.stringify(await daemon.get('/programs'))).toContain('work-drill.ngc');
    const { programs } = await daemon.get<{ programs: { id: number; name: string }[] }>('/programs');
    const id = programs.find((one) => one.name === 'work-drill.ngc')?.id;
    const text = await (await fetch(`${daemon.address}api/v1/programs/${id}/text`)).text();
    expect(text).toContain('Z7');
    expect(text).toContain('Z-2.5');
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('inputs and outputs', () => {
  it('are live, and outputs are switched in the output test mode only', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'pins');
    const flood = page.getByRole('region', { name: 'Manual outputs' }).getByRole('button', { name: /^Flood/ });
    expect(await flood.getAttribute('title')).toContain('Available only in output test mode');
    if ((await daemon.status()).owner.kind === 'client') {
      await click(page, 'Take control');
      await agree(page, 'Take control');
    }
    await page.getByRole('button', { name: /^Output test mode/ }).click();
    await agree(page, 'Output test mode');
    await page.getByRole('button', { name: 'End output test mode' }).waitFor();
    await flood.click();
    await daemon.until((status) => status.outputs.flood);
    await expect.poll(() => page.getByTestId('pin-flood').innerText()).toBe('on');
    await page.getByRole('button', { name: 'Spindle clockwise', exact: true }).click();
    await agree(page, 'Start the spindle');
    await daemon.until((status) => status.outputs.spindle === 'clockwise' && status.outputs.flood);
    await page.getByRole('button', { name: 'End output test mode' }).click();
    await daemon.until((status) => status.state === 'Idle' && !status.outputs.flood && status.outputs.spindle === 'off');
    await expect.poll(() => page.getByTestId('pin-flood').innerText()).toBe('off');
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('single pulses', () => {
  it('are shown with the times at which the board makes them', async () => {
    const { key } = (await daemon.post('/owner', '{"name": "story"}')) as { key: string };
    const { id } = (await daemon.post('/programs?name=pulses.ngc', 'G21 G91 G1 X1 F600\nM2\n')) as { id: number };
    await daemon.post(`/programs/${id}/run`, '', key);
    await daemon.until((status) => status.job?.state === 'done');
    await fetch(`${daemon.address}api/v1/owner`, { method: 'DELETE', headers: { 'X-Passo-Key': key } });
    const { page, context, errors } = await visit(browser, daemon, 'pins');
    const pulses = page.getByRole('region', { name: 'Single pulses' });
    const reading = (): Promise<string> => page.getByTestId('pulses').innerText();
    await expect.poll(reading).toMatch(/X \d+, [\d.]+ .s after the previous pulse: [\d,]+ steps\/s/);
    const canvas = pulses.getByRole('img', { name: 'Single pulses' });
    const wide = await canvas.screenshot();
    const countOf = (words: string): number => Number(/X (-?\d+)/.exec(words)?.[1]);
    const last = countOf(await reading());
    // From the end of the motion to its last pulse, and from there to the one before.
    for (const count of [last, last - 1]) {
      await pulses.getByRole('button', { name: 'Previous pulse' }).click();
      await expect.poll(async () => countOf(await reading())).toBe(count);
    }
    for (let i = 0; i < 4; ++i) await pulses.getByRole('button', { name: 'Zoom in' }).click();
    await expect.poll(async () => (await canvas.screenshot()).equals(wide)).toBe(false);
    expect(await violations(page)).toEqual([]);
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('a gamepad', () => {
  it('moves while its cross is held, and no longer', async () => {
    const { page, context } = await visit(browser, daemon, 'console');
    await page.evaluate(() => {
      const pad = { id: 'Pad', mapping: 'standard', connected: true, axes: [0, 0, 0, 0], buttons: Array.from({ length: 17 }, () => ({ pressed: false })) };
      Object.assign(window, { pad });
      navigator.getGamepads = () => [pad as unknown as Gamepad];
    });
    const press = (pressed: boolean): Promise<void> =>
      page.evaluate((to) => void ((window as unknown as { pad: { buttons: { pressed: boolean }[] } }).pad.buttons[15]!.pressed = to), pressed);
    // Elsewhere than on the page "Setup" it does nothing.
    await press(true);
    await page.goto(`${daemon.address}#/jog`);
    await page.getByText('Gamepad Pad').waitFor();
    await page.getByRole('radio', { name: 'Continuous' }).check();
    expect((await daemon.status()).state).toBe('Idle');
    await press(false);
    await page.waitForTimeout(200);
    if ((await daemon.status()).owner.kind === 'client') {
      await click(page, 'Take control');
      await agree(page, 'Take control');
      await page.locator('.owner').waitFor({ state: 'detached' });
    }
    await page.bringToFront();
    const before = (await daemon.status()).place.x ?? 0;
    await press(true);
    await daemon.until((status) => (status.place.x ?? 0) > before + 0.5);
    await press(false);
    const rest = await daemon.until((status) => status.state === 'Idle' && status.rests);
    await page.waitForTimeout(400);
    expect((await daemon.status()).place).toEqual(rest.place);
    await context.close();
  });
});

describe('the scene', () => {
  it('tells speed or depth by colours with figures, and cuts the path at a height', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'files');
    const part = 'G21 G90\nG0 X0 Y0 Z0\nG1 X10 F300\nG1 Z-4 F60\nG1 Y10 F1200\nM2\n';
    await page.setInputFiles('input[type=file]', { name: 'speeds.ngc', mimeType: 'text/plain', buffer: Buffer.from(part) });
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await page.goto(`${daemon.address}#/run`);
    const tells = page.getByRole('combobox', { name: 'Colour of the toolpath' });
    const legend = page.locator('.scene-legend');
    await tells.selectOption({ label: 'Colour by speed' });
    await expect.poll(() => legend.innerText()).toMatch(/^60\s+1200\s+mm\/min$/);
    await tells.selectOption({ label: 'Colour by depth' });
    await expect.poll(() => legend.innerText()).toMatch(/^Z -4\.00\s+Z 0\.00\s+mm$/);
    await page.getByRole('button', { name: 'Section', exact: true }).click();
    await expect.poll(() => page.locator('.scene-section').innerText()).toContain('Z -2.00 mm');
    await tells.selectOption({ label: 'One colour' });
    await legend.waitFor({ state: 'detached' });
    expect(errors).toEqual([]);
    await context.close();
  });
});
