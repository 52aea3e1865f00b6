// First contact with a board: the ports without opening them, the machine file of its settings, and the settings themselves.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Daemon, openBrowser, peers, Peer, systemWith, violations, visit } from './kit';

let browser: Browser;
let folder: string;
beforeAll(async () => {
  browser = await openBrowser();
  folder = mkdtempSync(join(tmpdir(), 'passo-board-'));
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

const hasPeers = existsSync(peers);
const pictures = process.env.PASSO_BOARD_PICTURES; // a folder, for whoever wants to look
const look = async (page: Page, name: string): Promise<void> => {
  if (pictures !== undefined) await page.screenshot({ path: `${pictures}/${name}.png`, fullPage: true });
};
const agree = (page: Page, name: string): Promise<void> => page.getByRole('dialog').getByRole('button', { name, exact: true }).click();

describe('without a board', () => {
  it('the first page lists the ports and who uses them, and opens one only after a warning', async () => {
    const system = systemWith(mkdtempSync(join(folder, 'list-')), [
      { name: 'ttyACM0', vendor: '2341', product: '0043', words: 'Arduino Uno', lasting: 'usb-Arduino_Uno_7543-if00' },
      { name: 'ttyUSB0', vendor: '1a86', product: '7523', words: 'USB Serial', user: { process: 4711, program: 'cncjs' } },
    ]);
    const daemon = await Daemon.start({ system });
    const { page, context, errors } = await visit(browser, daemon, 'run');
    const card = page.locator('.first-start');
    await card.getByText('2 USB serial ports').waitFor();
    await card.getByText('Arduino Uno', { exact: true }).waitFor();
    expect(await card.innerText()).toContain('2341:0043');
    expect(await card.innerText()).toContain('In use by cncjs (4711)');
    expect(await violations(page)).toEqual([]);
    // A port in use cannot be opened.
    const busy = page.getByRole('button', { name: /ttyUSB0/ });
    expect(await busy.getAttribute('aria-disabled')).toBe('true');
    await page.getByRole('button', { name: /ttyACM0/ }).click();
    const dialog = page.getByRole('dialog');
    expect(await dialog.innerText()).toContain('Opening this port restarts an Arduino.');
    await dialog.getByRole('button', { name: 'Cancel' }).click();
    expect(await daemon.get<{ state: string }>('/ports/open')).toMatchObject({ state: 'none' });
    // What is no serial port is told, and nothing else happens.
    await page.getByRole('button', { name: /ttyACM0/ }).click();
    await agree(page, 'Open the port');
    await page.getByRole('alert').waitFor();
    expect(await page.locator('.new-machine').innerText()).toContain('not a serial port');
    expect(await violations(page)).toEqual([]);
    await page.goto(`${daemon.address}#/run`);
    await card.getByRole('button', { name: 'Hide' }).click();
    await card.waitFor({ state: 'detached' });
    expect(errors).toEqual([]);
    await context.close();
    await daemon.end();
  });
});

// From the port to a machine file and the settings, and back.
async function firstContact(page: Page, controller: RegExp): Promise<string> {
  const machine = page.locator('.new-machine');
  await expect.poll(() => machine.innerText()).toMatch(controller);
  expect(await machine.locator('pre').first().innerText()).toContain('[axis.X]');
  await machine.getByRole('textbox', { name: 'File name' }).fill('mine.toml');
  await page.keyboard.press('Tab');
  await machine.getByRole('button', { name: 'Save on the server' }).click();
  await machine.getByText(/Saved as .*mine\.toml/).waitFor();
  const command = await machine.locator('.kept-machine pre').innerText();
  expect(command).toMatch(/^passo serve --machine \S+mine\.toml --board grbl:/);
  // It is not written twice.
  await machine.getByRole('button', { name: 'Save on the server' }).click();
  await page.getByText('there is already a machine file mine.toml').first().waitFor();
  const path = /--machine (\S+)/.exec(command)?.[1] ?? '';
  expect(readFileSync(path, 'utf8')).toContain('[axis.Z]');
  return path;
}

async function useSettings(page: Page, name: string): Promise<void> {
  const section = page.getByRole('region', { name: 'Settings of the board' });
  await section.getByRole('button', { name: 'Read the settings' }).click();
  const row = section.locator('tr[data-setting="$110"]');
  await row.waitFor();
  const field = row.getByRole('textbox');
  const before = await field.inputValue();
  expect(await row.innerText()).toMatch(/mm\/min/);
  if (pictures !== undefined) await section.screenshot({ path: `${pictures}/${name}-settings.png` });
  expect(await violations(page)).toEqual([]);
  // A value that the firmware does not take leaves the old one.
  await field.fill('-5');
  await page.keyboard.press('Tab');
  await section.getByRole('button', { name: 'Write the changes' }).click();
  await agree(page, 'Write the changes');
  await section.getByText('$110 was not written').waitFor();
  // A good one is read back.
  await field.fill('432.5');
  await page.keyboard.press('Tab');
  await section.getByRole('button', { name: 'Write the changes' }).click();
  expect(await page.getByRole('dialog').innerText()).toContain('432.5');
  await agree(page, 'Write the changes');
  await section.getByText(/^\$110: .* → 432\.5/).waitFor();
  // The file from before brings the old value back.
  const file = join(folder, `${name}.txt`);
  writeFileSync(file, `$110=${before}\n`);
  await section.locator('input[type=file]').setInputFiles(file);
  await section.getByText(/settings? differs? from/).waitFor();
  expect(await section.locator('.compared').innerText()).toContain('432.5');
  await look(page, `${name}-compared`);
  await section.getByRole('button', { name: /^Restore from the file/ }).click();
  await agree(page, 'Restore from the file');
  await expect.poll(() => row.getByRole('textbox').inputValue()).toBe(before);
}

describe.skipIf(!hasPeers)('a real board', () => {
  it('with Grbl 1.1h on an Uno is connected to, imported, set up and served', async () => {
    const uno = join(folder, 'uno');
    execFileSync(join(peers, 'build.sh'), [uno]);
    const line = join(folder, 'uno-line');
    const peer = await Peer.start([uno, join(peers, 'grbl-1.1h-uno.elf'), line], folder, () => existsSync(line));
    const system = systemWith(mkdtempSync(join(folder, 'uno-')), [
      { name: 'ttyACM0', vendor: '2341', product: '0043', words: 'Arduino Uno', leadsTo: line, lasting: 'usb-Arduino_Uno_7543-if00' },
    ]);
    let daemon = await Daemon.start({ system });
    const { page, context, errors } = await visit(browser, daemon, 'run');
    await page.getByRole('button', { name: /ttyACM0/ }).click();
    await look(page, 'uno-warning');
    await agree(page, 'Open the port');
    const path = await firstContact(page, /Grbl answers at grbl:/);
    await look(page, 'uno-machine');
    expect(await violations(page)).toEqual([]);
    await useSettings(page, 'uno');
    expect(errors.filter((one) => !one.includes('Failed to load'))).toEqual([]);
    await context.close();
    const kept = join(folder, 'mine.toml');
    writeFileSync(kept, readFileSync(path, 'utf8'));
    await daemon.end();

    // The server that drives the board reads its settings over its own connection.
    daemon = await Daemon.start({ system, machine: kept, address: `grbl:${join(system, 'dev/ttyACM0')}` });
    const served = await visit(browser, daemon, 'machine?part=board', { theme: 'light' });
    await useSettings(served.page, 'uno-served');
    await look(served.page, 'uno-served');
    expect((await daemon.status()).state).not.toBe('Fault');
    await served.context.close();
    await daemon.end();
    await peer.end();
  });

  it('with grblHAL on the network is connected to, imported and set up', async () => {
    const port = 20_000 + (process.pid % 20_000);
    const words = [join(peers, 'grblHAL_sim'), '-n', '-p', String(port), '-t', '1', '-e', 'eeprom.dat'];
    const peer = await Peer.start(words, folder, () => existsSync(join(folder, 'eeprom.dat')));
    const daemon = await Daemon.start({ system: systemWith(mkdtempSync(join(folder, 'hal-')), []) });
    const { page, context, errors } = await visit(browser, daemon, 'machine?part=board', { size: { width: 390, height: 844 } });
    await page.getByText('No USB serial port found').first().waitFor();
    await page.getByRole('textbox', { name: 'Network address' }).fill(`127.0.0.1:${port}`);
    await page.keyboard.press('Tab');
    await page.getByRole('button', { name: 'Connect to Network address' }).click();
    await firstContact(page, /grblHAL answers at grbl:tcp:/);
    await useSettings(page, 'hal');
    expect(errors.filter((one) => !one.includes('Failed to load'))).toEqual([]);
    await context.close();
    await daemon.end();
    await peer.end();
  });
});
