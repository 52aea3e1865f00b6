// Drawings become programs, with a picture that follows the form.
import { describe, expect, it } from 'vitest';
import { Daemon, example, visit } from './kit';
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

// Two pads with a hole in each, on a board of 10 x 8 mm.
const gerber = (layer: string, shapes: string): string => `%FSLAX46Y46*%\n%MOMM*%\n%TF.FileFunction,${layer}*%\n%ADD10C,1.6*%\n%ADD11C,0.1*%\n${shapes}M02*\n`;
const small = {
  'small-F_Cu.gbr': gerber('Copper,L1,Top', 'D10*\nX2500000Y4000000D03*\nX7500000Y4000000D03*\n'),
  'small-Edge_Cuts.gbr': gerber('Profile,NP', 'D11*\nX0Y0D02*\nX10000000Y0D01*\nX10000000Y8000000D01*\nX0Y8000000D01*\nX0Y0D01*\n'),
  'small.drl': 'M48\nMETRIC\nT1C0.8\n%\nT1\nX2.5Y4.0\nX7.5Y4.0\nM30\n',
};

describe('a small board', () => {
  it('is drilled, milled and cut out on the machine, from its Gerber files', async () => {
    const machine = await Daemon.start({ machine: example('machines/strong-router.toml') });
    const { page, context, errors } = await visit(browser, machine, 'cam');
    await page.setInputFiles('input[type=file]', Object.entries(small).map(([name, text]) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) })));
    await page.getByRole('heading', { name: 'Work steps' }).waitFor();
    // Fast, so that the story is short.
    const values: [RegExp, string][] = [[/^Spindle speed/, '0'], [/^(Feed rate|Plunge feed)/, '3000']];
    for (const options of await page.locator('details', { has: page.locator('summary', { hasText: ': options' }) }).all()) {
      await options.locator('summary').click();
      for (const [name, value] of values) {
        for (const field of await options.getByRole('textbox', { name }).all()) await field.fill(value);
      }
    }
    const programs = async (): Promise<{ id: number; name: string }[]> => (await machine.get<{ programs: { id: number; name: string }[] }>('/programs')).programs;
    const text = async (id: number): Promise<string> => (await fetch(`${machine.address}api/v1/programs/${id}/text`)).text();
    await expect.poll(async () => (await Promise.all((await programs()).map(async ({ id }) => text(id)))).filter((one) => !one.includes('M3') && one.includes('F3000')).length).toBe(3);
    await expect.poll(() => page.getByTestId('cam-state').innerText()).toBe('Generated');
    const names = (await programs()).map((one) => one.name).sort();
    expect(names).toEqual(['small-F_Cu-1-drill.ngc', 'small-F_Cu-2-isolate-front.ngc', 'small-F_Cu-3-outline.ngc']);
    for (const [index, name] of names.entries()) {
      await page.goto(`${machine.address}#/cam`);
      await page.getByRole('button', { name: /^Show this program/ }).nth(index).click();
      await expect.poll(() => page.locator('h2.title').innerText()).toBe(name);
      await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings)/);
      await page.getByRole('button', { name: 'Open', exact: true }).click();
      await page.getByRole('button', { name: 'Start', exact: true }).first().click();
      await page.getByRole('dialog').getByRole('button', { name: 'Start' }).click();
      const ended = await machine.until((status) => status.job?.name === name && status.job.state === 'done');
      for (const axis of ['x', 'y'] as const) expect(ended.place[axis]).toBeCloseTo(0, 2); // the park position
    }
    const { jobs } = await machine.get<{ jobs: { name: string; state: string }[] }>('/history');
    expect(jobs.map((job) => `${job.name} ${job.state}`).sort()).toEqual(names.map((name) => `${name} done`));
    expect(errors).toEqual([]);
    await context.close();
    await machine.end();
  });
});
