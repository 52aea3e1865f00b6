// Drawings become programs, with a picture that follows the form.
import { describe, expect, it } from 'vitest';
import { example, visit } from './kit';
import { beginStage, browser, daemon } from './stage';

beginStage();

const holes = 'M48\nMETRIC\nT1C0.800\n%\nT1\nX10.0Y10.0\nX20.0Y10.0\nX20.0Y25.0\nM30\n';

describe('a drill file', () => {
  it('becomes a program whose picture follows the form, and what is wrong is told', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'cam');
    const send = (name: string, text: string): Promise<void> =>
      page.setInputFiles('input[type=file]', { name, mimeType: 'text/plain', buffer: Buffer.from(text) });
    await send('holes.drl', holes);
    await expect.poll(() => page.getByTestId('cam-state').innerText()).toBe('Generated');
    const picture = page.getByRole('img', { name: 'Picture of the cut' });
    await picture.waitFor();
    await expect.poll(() => picture.evaluate((one) => (one as HTMLImageElement).naturalWidth)).toBeGreaterThan(0);
    const before = await picture.getAttribute('src');
    await page.getByRole('textbox', { name: 'Depth', exact: true }).fill('-3.25');
    await page.getByRole('checkbox', { name: 'No canned cycles' }).check();
    await expect.poll(() => picture.getAttribute('src')).not.toBe(before);
    const text = async (): Promise<string> => {
      const { programs } = await daemon.get<{ programs: { id: number }[] }>('/programs');
      // Made again, it takes the place of the one before.
      expect(programs.length).toBe(1);
      return (await fetch(`${daemon.address}api/v1/programs/${programs[0]?.id}/text`)).text();
    };
    await expect.poll(text).toContain('Z-3.25');
    await page.getByRole('button', { name: 'Show the program' }).click();
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings|Steps are lost)/);
    await page.goto(`${daemon.address}#/cam`);
    await send('wrong.drl', 'this is no drill file\n');
    await page.getByRole('checkbox', { name: 'holes.drl' }).uncheck();
    await page.getByRole('checkbox', { name: 'wrong.drl' }).check();
    await expect.poll(() => page.getByTestId('cam-state').innerText()).toBe('Not generated');
    expect(await page.locator('.cam-result pre').innerText()).toContain('wrong.drl');
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('a whole board', () => {
  it('becomes programs in the order in which they are run, and a layer that was guessed wrong is told', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'cam');
    const files = ['timer-B_Cu.gbr', 'timer-Edge_Cuts.gbr', 'timer.drl'].map((name) => example(`boards/${name}`));
    await page.setInputFiles('input[type=file]', files);
    await page.getByRole('heading', { name: 'Work steps' }).waitFor();
    const steps = (): Promise<string[]> => page.locator('.board-step h3').allInnerTexts();
    expect((await steps()).map((one) => one.split('\n')[0])).toEqual(['1. Clamp the blank', '2. Drill', '3. Mill the back', '4. Cut the board out']);
    const layers = page.getByRole('region', { name: 'Layers: check each file' });
    expect(await layers.getByRole('combobox').evaluateAll((all) => all.map((one) => (one as HTMLSelectElement).value))).toEqual(['bottom copper', 'outline', 'drill']);
    await layers.getByRole('combobox', { name: 'timer-B_Cu.gbr' }).selectOption('top copper');
    await expect.poll(async () => (await steps()).join()).toContain('Mill the front');
    const { programs } = await daemon.get<{ programs: { name: string }[] }>('/programs');
    const names = programs.map((one) => one.name).filter((name) => name.startsWith('timer-B_Cu'));
    expect(names).toEqual(['timer-B_Cu-1-drill.ngc', 'timer-B_Cu-2-isolate-front.ngc', 'timer-B_Cu-3-outline.ngc']);
    for (const picture of await page.locator('.board-step img').all()) {
      await picture.scrollIntoViewIfNeeded();
      await expect.poll(() => picture.evaluate((one) => (one as HTMLImageElement).naturalWidth)).toBeGreaterThan(0);
    }
    await page.getByRole('button', { name: 'Show this program: 2-isolate-front.ngc' }).click();
    await expect.poll(() => page.locator('h2.title').innerText()).toBe('timer-B_Cu-2-isolate-front.ngc');
    expect(errors).toEqual([]);
    await context.close();
  });
});
