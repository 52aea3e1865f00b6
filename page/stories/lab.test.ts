// The lab in the real browser: what a teacher and a class do with it.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { violations, visit } from './kit';
import { beginStage, browser, daemon } from './stage';

beginStage();

const query = (page: Page): URLSearchParams => new URLSearchParams(page.url().split('?')[1] ?? '');
const judgement = async (page: Page): Promise<string> => (await page.locator('.lab-judgement').innerText()).replace(/\s+/g, ' ');

async function drag(page: Page, what: string, right: number, down: number): Promise<void> {
  await page.locator(what).scrollIntoViewIfNeeded();
  const box = await page.locator(what).boundingBox();
  if (box === null) throw new Error(`${what} is not seen`);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 8 });
  await page.mouse.up();
}

describe('the lab', () => {
  it('shows the move whose end point is dragged, or moved by keys', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'lab');
    const end = page.locator('.lab-end');
    await end.waitFor();
    expect(await end.getAttribute('aria-valuetext')).toBe('x 10, y 4');
    await end.focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('Shift+ArrowDown');
    expect(await end.getAttribute('aria-valuetext')).toBe('x 9, y -6');
    await expect.poll(() => query(page).get('to')).toBe('9,-6');
    await drag(page, '.lab-end .lab-ring', -80, -60);
    await expect.poll(() => query(page).get('to')).not.toBe('9,-6');
    // A place that is shown in the address and in the fields is the place of the handle.
    const [x, y] = (query(page).get('to') ?? '').split(',');
    expect(await end.getAttribute('aria-valuetext')).toBe(`x ${x}, y ${y}`);
    expect(await page.getByLabel('End point X').inputValue()).toBe(x);
    expect(errors).toEqual([]);
    await context.close();
  });

  it('goes pulse by pulse with its judgement, and plays to the end', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?a=point-comparison&to=3,2&beat=0');
    await page.locator('.lab-end').focus();
    await page.keyboard.press('.');
    await expect.poll(() => judgement(page)).toContain('F ≥ 0 → +X (1, 0) Error 0.555');
    await page.keyboard.press('.');
    await expect.poll(() => judgement(page)).toContain('F < 0 → +Y (1, 1) Error 0.277');
    await page.keyboard.press(',');
    await expect.poll(() => page.locator('.lab-player output').innerText()).toBe('1 / 5');
    await page.getByRole('button', { name: 'Play' }).click();
    await expect.poll(() => page.locator('.lab-player output').innerText()).toBe('5 / 5');
    await context.close();
  });

  it('is reproduced by a link', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?part=loop&kp=0.05&ki=7');
    await page.locator('.lab-chart').first().waitFor();
    expect(await page.getByRole('spinbutton', { name: 'kp' }).inputValue()).toBe('0.05');
    await page.getByRole('button', { name: 'PI', exact: true }).click();
    await expect.poll(() => Number(query(page).get('kp'))).toBeCloseTo(0.0403, 2);
    const link = page.url();
    await page.goto('about:blank');
    await page.goto(link);
    await expect.poll(async () => Number(await page.getByRole('spinbutton', { name: 'kp' }).inputValue())).toBeCloseTo(0.0403, 2);
    await context.close();
  });

  it('needs no machine, and keeps an arc on its circle', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?shape=arc&a=midpoint');
    await page.locator('.lab-end').waitFor();
    await drag(page, '.lab-end .lab-ring', -150, 120);
    await expect.poll(() => query(page).get('end')).toBeTruthy();
    const [x = 0, y = 0] = (query(page).get('end') ?? '').split(',').map(Number);
    expect(Math.abs(Math.hypot(x, y) - 8)).toBeLessThan(1);
    for (const tab of ['Ramps', 'Torque', 'Closed loop']) {
      await page.getByRole('tab', { name: tab }).click();
      await page.locator('.lab-chart').first().waitFor();
    }
    await context.close();
  });

  it('plays the first board by keys and by the bits of its port', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'lab?part=board');
    const mode = page.locator('.lab-mode');
    const place = (axis: string) => page.locator(`[data-axis=${axis}] [data-place]`).innerText();
    const led = (name: string) => page.locator(`[data-led=${name}]`).getAttribute('class');
    await mode.waitFor();
    expect(await mode.getAttribute('data-mode')).toBe('waiting');
    // Before a mode key a clock moves nothing.
    const clockX = page.locator('[data-pin="2"]');
    await clockX.click();
    await page.keyboard.press('*', { delay: 80 });
    await expect.poll(() => mode.getAttribute('data-mode')).toBe('automatic');
    expect(await place('X')).toBe('0.00 mm');
    await clockX.click();
    await clockX.click();
    await expect.poll(() => place('X')).toBe('0.02 mm');
    expect(await page.locator('[data-register=data]').innerText()).toBe('0x01');
    // Direction 1 turns back, at the next rising edge.
    await page.locator('[data-pin="5"]').click();
    await clockX.click();
    await clockX.click();
    await expect.poll(() => place('X')).toBe('0.00 mm');
    // Key 5 raises Z, and RD1 is lit meanwhile.
    await page.keyboard.press('#', { delay: 80 });
    await expect.poll(() => led('RD1')).toBe('lab-led');
    await page.keyboard.down('5');
    await expect.poll(() => led('RD1')).toBe('lab-led lit');
    await page.keyboard.up('5');
    expect(Number.parseFloat(await place('Z'))).toBeGreaterThan(0);
    // The emergency button: the status bit is 0 while its inverted pin is high.
    const stop = page.getByRole('button', { name: 'Emergency stop' });
    await stop.focus();
    await page.keyboard.down('Enter');
    await expect.poll(() => page.locator('[data-register=status]').innerText()).toBe('0x00');
    await page.keyboard.up('Enter');
    await expect.poll(() => mode.getAttribute('data-mode')).toBe('waiting');
    expect(await violations(page)).toEqual([]);
    expect(errors).toEqual([]);
    await context.close();
  });

  it('listens to the keys at once, and shows midlines, fractions and the lines of the code', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'lab?to=7,3&beat=0');
    await page.locator('.lab-end').waitFor();
    await page.keyboard.press('.');
    await page.keyboard.press('.');
    await expect.poll(() => page.locator('.lab-player output').innerText()).toBe('2 / 7');
    await expect.poll(() => page.locator('.lab-midlines .lab-now text').textContent()).toBe('6/7');
    expect(await page.locator('.lab-midlines path').count()).toBe(7);
    expect((await page.locator('.lab-code .lab-ran').allInnerTexts()).join(' ')).toMatch(/\+\+p\[j\];\s+X Y/);
    await page.keyboard.press(',');
    await expect.poll(() => page.locator('.lab-player output').innerText()).toBe('1 / 7');
    expect(errors).toEqual([]);
    await context.close();
  });

  it('begins the integration with the register as it is loaded', async () => {
    for (const [method, start] of [['dda', 'a[j] = 0;'], ['dda-half', 'a[j] = (1 << bits)/2;']] as const) {
      const { page, context } = await visit(browser, daemon, `lab?to=7,3&a=${method}&beat=0`);
      await expect.poll(() => page.locator('.lab-code code').first().innerText()).toBe(start);
      await context.close();
    }
  });

  it('refuses two lines on one pin, and reproduces another assignment by a link', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?part=board&mode=automatic&unit=inch&perunit=1270,1270,1270');
    const clockY = page.getByRole('combobox', { name: 'Clock Y' });
    await clockY.selectOption('2');
    await page.getByText('Pin 2 is already assigned to “Clock X”, so “Clock Y” cannot use it.').waitFor();
    expect(await clockY.inputValue()).toBe('3');
    await clockY.selectOption('14');
    await expect.poll(() => query(page).get('lpt')).toBe('2.14.4.5.6.7.8.10.12.13.15.11');
    const link = page.url();
    await page.goto('about:blank');
    await page.goto(link);
    const control = page.locator('[data-pin="14"]');
    await expect.poll(() => page.locator('.lab-mode').getAttribute('data-mode')).toBe('automatic');
    await control.click();
    await expect.poll(() => page.locator('[data-axis=Y] [data-place]').innerText()).toBe('0.0008 in');
    // The arrow keys move an axis as long as they are held, and the program counts the pulses.
    await page.getByRole('button', { name: 'X+' }).last().focus();
    await page.keyboard.down('ArrowRight');
    await expect.poll(() => page.locator('[data-axis=X] [data-counted]').innerText()).not.toBe('0.0000 in');
    await page.keyboard.up('ArrowRight');
    const counted = await page.locator('[data-axis=X] [data-counted]').innerText();
    expect(await page.locator('[data-axis=X] [data-place]').innerText()).toBe(counted);
    await context.close();
  });

  it('moves only motors whose clock has a pin, stops on its way, and jogs no longer than the key is down', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'lab?part=board&mode=automatic&lpt=0.3.4.5.6.7.8.10.12.13.15.11&hz=5000');
    const place = (axis: string) => page.locator(`[data-axis=${axis}] [data-place]`).innerText();
    const counted = (axis: string) => page.locator(`[data-axis=${axis}] [data-counted]`).innerText();
    await expect.poll(() => page.locator('.lab-mode').getAttribute('data-mode')).toBe('automatic');
    expect(await page.locator('.lab > .lab-refused').innerText()).toContain('hz=5000');
    const clock = page.locator('.lab-clock > button');
    await clock.click();
    await expect.poll(() => counted('X')).not.toBe('0.00 mm');
    expect(await place('X')).toBe('0.00 mm');
    await clock.click();
    // Z to its height is a clock that stops.
    await page.getByRole('button', { name: 'Z to clearance height' }).click();
    await expect.poll(() => clock.innerText()).toBe('Stop the clock');
    await expect.poll(() => place('Z')).not.toBe('0.00 mm');
    await clock.click();
    await expect.poll(() => clock.innerText()).toBe('Start the clock');
    const stopped = await place('Z');
    expect(stopped).not.toBe('2.00 mm');
    // Each way to leave a key that is down ends the jogging.
    const jog = page.getByRole('button', { name: 'Y+' }).last();
    const leave = [
      () => page.locator('.lab-key').first().focus(),
      () => page.evaluate(() => dispatchEvent(new Event('blur'))),
      () => page.evaluate(() => {
        Object.defineProperty(document, 'hidden', { value: true, configurable: true });
        document.dispatchEvent(new Event('visibilitychange'));
      }),
    ];
    for (const go of leave) {
      await jog.focus();
      const before = await place('Y');
      await page.keyboard.down('ArrowUp');
      await expect.poll(() => place('Y')).not.toBe(before);
      await go();
      await expect.poll(() => jog.getAttribute('aria-pressed')).toBe('false');
      const left = await place('Y');
      await page.waitForTimeout(200);
      expect(await place('Y')).toBe(left);
      await page.keyboard.up('ArrowUp');
    }
    expect(await place('Z')).toBe(stopped);
    expect(errors).toEqual([]);
    await context.close();
  });

  it('obeys another link in the same window', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?part=board');
    const mode = page.locator('.lab-mode');
    await expect.poll(() => mode.getAttribute('data-mode')).toBe('waiting');
    await page.evaluate(() => {
      location.hash = '#/lab?part=board&mode=automatic&run=1';
    });
    await expect.poll(() => mode.getAttribute('data-mode')).toBe('automatic');
    await expect.poll(() => page.locator('[data-axis=X] [data-place]').innerText()).not.toBe('0.00 mm');
    await context.close();
  });

  it('keeps its fields where an answer is refused', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?part=driver', { language: 'fr' });
    const logic = page.locator('.lab-base input').nth(1);
    await logic.fill('1');
    await expect.poll(() => page.locator('.lab-refused').innerText()).toBe('Le niveau logique haut doit dépasser la tension base-émetteur.');
    await page.keyboard.type('2');
    await expect.poll(() => page.locator('[data-largest]').count()).toBe(1);
    expect(await logic.inputValue()).toBe('12');
    await context.close();
    const steps = await visit(browser, daemon, 'lab?to=9,1&a=listing:slope-blocks');
    const end = steps.page.locator('.lab-end');
    await end.focus();
    await steps.page.keyboard.press('ArrowDown');
    await expect.poll(() => steps.page.locator('.lab-stage .lab-refused').first().innerText()).toContain('divides by zero');
    await steps.page.keyboard.press('ArrowUp');
    await expect.poll(() => steps.page.locator('.lab-player output').innerText()).toMatch(/^(\d+) \/ \1$/);
    expect(steps.errors).toEqual([]);
    await steps.context.close();
  });

  it('shows why the base resistor is ample', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?part=driver');
    expect(await page.locator('[data-largest]').innerText()).toBe('2077 Ω');
    expect(await page.locator('[data-overdrive]').innerText()).toContain('5.74 times');
    await page.getByRole('spinbutton', { name: 'Base resistor' }).fill('2200');
    await expect.poll(() => page.locator('[data-overdrive]').innerText()).toContain('not enough');
    expect(await violations(page)).toEqual([]);
    await context.close();
  });

  it('moves any number of motors, and shows two of them on the grid', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?to=10,4,7');
    await page.locator('.lab-end').waitFor();
    await page.getByRole('button', { name: 'Add a motor' }).click();
    await expect.poll(() => query(page).get('to')).toBe('10,4,7,3');
    expect(await page.locator('.lab-strip-name').allTextContents()).toEqual(expect.arrayContaining(['X', 'Y', 'Z', 'A']));
    await page.getByRole('combobox', { name: /^Up/ }).selectOption('z');
    await expect.poll(() => page.locator('.lab-end').getAttribute('aria-valuetext')).toBe('x 10, y 7');
    await expect.poll(() => judgement(page)).toContain('(10, 4, 7, 3)');
    await context.close();
  });

  it('shows a faulty listing beside the right method, with its wrong steps and its wrong end', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?to=3,29');
    await page.locator('.lab-end').waitFor();
    await page.getByLabel('A · Method').selectOption('listing:slope-blocks');
    await expect.poll(() => query(page).get('b')).toBe('slope-blocks');
    expect(await page.locator('.lab-stage .lab-refused').innerText()).toContain('Wrong from pulse 10 on; wrong steps are red. It ends at (6, 27).');
    expect(await page.locator('path.lab-wrong').count()).toBe(4); // three steps and the end
    await context.close();
  });

  it('names what a link asks for and cannot be, and answers when the link is copied', async () => {
    const { page, context } = await visit(browser, daemon, 'lab?to=201,1&a=wu');
    const refused = page.locator('.lab > .lab-refused');
    await refused.first().waitFor();
    expect((await refused.allInnerTexts()).join(' ')).toMatch(/to=201,1 is not possible.*−200 … 200.*a=wu is not possible/s);
    await page.getByRole('button', { name: 'Copy the link' }).click();
    await expect.poll(() => page.locator('.lab-copy [role=status]').innerText()).toMatch(/^(Copied|The browser)/);
    await context.close();
  });

  it('has no English words in another language', async () => {
    for (const [language, method, words] of [['it', 'master-slave', 'ideale'], ['fr', 'lean', 'somme'], ['zh', 'slope-blocks', '段']] as const) {
      const { page, context } = await visit(browser, daemon, `lab?a=${method}&to=10,4&beat=3`, { language });
      await page.locator('.lab-end').waitFor();
      const text = `${await page.locator('.lab-judgement').innerText()} ${await page.locator('.lab-beats thead').innerText()}`;
      expect(text.toLowerCase()).toContain(words);
      expect(text).not.toMatch(/ideal_|midline|sum_|decision|accumulator|blocks|\bplain\b|\bleft\b| of /);
      await context.close();
    }
  });
});
