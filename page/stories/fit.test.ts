// All pages in all languages fit a small laptop and a phone: nothing is cut off, nothing lies over another, nothing scrolls sideways.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { visit } from './kit';
import { beginStage, browser, daemon } from './stage';

beginStage();

const paths = ['run', 'jog', 'files', 'cam', 'console', 'pins', 'machine', 'machine?part=board', 'lab', 'lab?part=board', 'lab?part=driver'];
const pictures = process.env.PASSO_FIT_PICTURES; // a folder, for whoever wants to look
const sizes = [{ width: 1366, height: 768 }, { width: 390, height: 844 }] as const;

// What does not fit, in words. A name may end in an ellipsis. The program's text, the row of the
// stock's tools, the lab's tables of numbers, and on a phone the table of the machine file slide in frames of their own.
function misfits(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const found: string[] = [];
    const root = document.documentElement;
    if (root.scrollWidth > innerWidth) found.push(`the document is ${root.scrollWidth} wide`);
    const named = (one: Element): string => `${one.tagName.toLowerCase()}.${[...one.classList].join('.')} "${(one.textContent ?? '').trim().slice(0, 40)}"`;
    const isSeen = (one: Element): boolean => one.checkVisibility({ visibilityProperty: true }) && one.getClientRects().length > 0 && one.closest('.unseen, .skip') === null;
    const scrollsItself = (one: Element): boolean => ['auto', 'scroll'].includes(getComputedStyle(one).overflowX);
    for (const one of document.body.querySelectorAll<HTMLElement>('*')) {
      if (!isSeen(one) || one.closest('svg') !== null) continue;
      const { overflowX, textOverflow } = getComputedStyle(one);
      const ownText = [...one.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && (node.textContent ?? '').trim() !== '');
      if (['hidden', 'clip'].includes(overflowX) && textOverflow !== 'ellipsis' && one.scrollWidth > one.clientWidth + 1) found.push(`${named(one)} is cut off`);
      const maySlide = one.closest('.text, .scene-stock, .lab-table-frame, pre') !== null || (innerWidth < 700 && one.matches('.editor')) || one.matches('input, select, textarea');
      if (scrollsItself(one) && !maySlide && one.scrollWidth > one.clientWidth + 1) found.push(`${named(one)} scrolls sideways`);
      const right = one.getBoundingClientRect().right;
      const inScroller = (() => {
        for (let up = one.parentElement; up !== null; up = up.parentElement) if (scrollsItself(up) && up.scrollWidth > up.clientWidth + 1 && up !== document.querySelector('main')) return true;
        return false;
      })();
      if (ownText && right > innerWidth + 1 && !inScroller) found.push(`${named(one)} goes beyond the window`);
      // Words of a button stay in it.
      const holder = one.closest('button, .choice label, nav a');
      if (ownText && holder !== null && one !== holder) {
        const [inner, outer] = [one.getBoundingClientRect(), holder.getBoundingClientRect()];
        if (inner.right > outer.right + 1.5 || inner.left < outer.left - 1.5) found.push(`${named(one)} is wider than its button`);
      }
    }
    // Controls and titles do not lie over one another.
    const solid = [...document.querySelectorAll('main :is(button, input, select, h2, .digits, .axis-machine, label > span), .actions button, nav a, .head button, .state-title')].filter(isSeen);
    const boxes = solid.map((one) => one.getBoundingClientRect());
    for (let i = 0; i < solid.length; ++i) {
      for (let k = i + 1; k < solid.length; ++k) {
        const [a, b, one, other] = [boxes[i]!, boxes[k]!, solid[i]!, solid[k]!];
        if (one.contains(other) || other.contains(one)) continue;
        // What scrolls in the content goes under the frame around it.
        if ((one.closest('main') === null) !== (other.closest('main') === null)) continue;
        if (one.matches('input[type=radio], input[type=checkbox]') || other.matches('input[type=radio], input[type=checkbox]')) continue;
        if (one.closest('.scene') !== null || other.closest('.scene') !== null) continue;
        const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (wide > 2 && high > 2) found.push(`${named(one)} lies over ${named(other)}`);
      }
    }
    return found;
  });
}

// The page is laid out anew.
const settled = (page: Page): Promise<unknown> => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

describe('every page in every language', () => {
  it('fits a small laptop and a phone', async () => {
    // Something to show: a program with findings, and another owner.
    await daemon.post('/programs?name=a-part-with-a-rather-long-name.ngc', 'G21 G90\nS1000\nG1 X10 F300\nT1\nX20 5\nM2\n');
    const { key } = (await daemon.post('/owner', '{"name": "Firefox on Android"}')) as { key: string };
    const { page, context } = await visit(browser, daemon, 'run', { size: sizes[0] });
    const all: string[] = [];
    for (const language of ['en', 'it', 'fr', 'zh']) {
      await page.evaluate((to) => localStorage.setItem('passo.language', JSON.stringify(to)), language);
      await page.reload();
      await page.locator('.owner').first().waitFor();
      for (const path of paths) {
        await page.evaluate((to) => void (location.hash = `/${to}`), path);
        await page.locator(`main.page-${path.split('?')[0]} :is(section, form, .panel)`).first().waitFor();
        for (const size of sizes) {
          await page.setViewportSize(size);
          await settled(page);
          all.push(...(await misfits(page)).map((one) => `${size.width} ${language} ${path}: ${one}`));
          if (pictures !== undefined) await page.screenshot({ path: `${pictures}/${size.width}-${language}-${path.replace('?', '-')}.png` });
        }
      }
    }
    await fetch(`${daemon.address}api/v1/owner`, { method: 'DELETE', headers: { 'X-Passo-Key': key } });
    expect(all).toEqual([]);
    await context.close();
  });
});
