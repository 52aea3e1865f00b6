// The lab in the real browser: what a teacher and a class do with it.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { visit } from './kit';
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
});
