// A drawing becomes a job of several operations, and the job a cut part.
import { describe, expect, it } from 'vitest';
import { Daemon, example, violations, visit } from './kit';
import { beginStage, browser, daemon } from './stage';

beginStage();

const tag = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="24mm" height="16mm" viewBox="0 0 24 16">
<g inkscape:groupmode="layer" inkscape:label="edge" fill="none" stroke="red"><rect x="0" y="0" width="24" height="16" rx="3"/></g>
<g inkscape:groupmode="layer" inkscape:label="window" fill="none" stroke="blue"><rect x="8" y="4" width="8" height="8"/></g>
</svg>`;

interface Draft {
  text: string;
  good: boolean;
  operations: { values: Record<string, unknown> }[];
}

describe('a drawing', () => {
  it('becomes a job, whose operations are chosen by clicks and ordered by drags, and a cut part', async () => {
    const machine = await Daemon.start({ machine: example('machines/strong-router.toml') });
    const { page, context, errors } = await visit(browser, machine, 'cam');
    const draft = (): Promise<Draft> => machine.get<Draft>('/cam/job?name=tag.toml');
    const values = async (key: string): Promise<unknown[]> => (await draft()).operations.map((one) => one.values[key]);
    await page.getByRole('radio', { name: 'Job with several operations' }).check({ force: true });
    await page.setInputFiles('input[type=file]', { name: 'tag.svg', mimeType: 'image/svg+xml', buffer: Buffer.from(tag) });
    await page.getByRole('button', { name: 'New job from tag.svg' }).click();
    const rows = page.locator('.job-row');
    await expect.poll(() => rows.count()).toBe(1);
    // A click on a shape selects its layer.
    const shape = (layer: string) => page.locator(`[data-testid=job-picture] [data-layer=${layer}] .job-hit`);
    const box = (await shape('edge').boundingBox())!; // with its wide line
    await shape('edge').click({ position: { x: box.width * 0.27, y: box.height / 2 } });
    await expect.poll(() => values('layer')).toEqual(['edge']);
    await page.getByRole('button', { name: 'Add an operation' }).click();
    await expect.poll(() => rows.count()).toBe(2);
    await shape('window').click();
    await expect.poll(() => values('layer')).toEqual(['edge', 'window']);
    await rows.nth(0).hover();
    await expect.poll(() => page.locator('.job-shape.on').evaluateAll((all) => all.map((one) => one.getAttribute('data-layer')))).toEqual(['edge']);
    const form = page.getByTestId('job-form');
    const fill = async (name: string, value: string): Promise<void> => {
      await form.getByRole('textbox', { name, exact: true }).fill(value);
      await form.getByRole('textbox', { name, exact: true }).press('Enter');
    };
    await fill('Title', 'the window');
    await fill('Depth', '-1');
    await expect.poll(() => values('depth')).toEqual([-2, -1]);
    await rows.nth(0).getByRole('button', { name: /^1\. / }).click();
    await fill('Feed rate, per minute', '3000');
    // An error stands at its operation and its field.
    await fill('Depth', 'deep');
    await expect.poll(() => rows.nth(0).innerText()).toMatch(/deep/);
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => values('depth')).toEqual([-2, -1]);
    await expect.poll(() => page.getByTestId('cam-state').innerText(), { timeout: 30_000 }).toBe('Generated');
    await expect.poll(() => page.getByTestId('job-figures').count()).toBe(2);
    expect(await rows.nth(0).innerText()).toMatch(/time \d+:\d\d[\s\S]*depth 2\.0 mm/);
    // Comments and keys that nobody knows stay, whatever is moved.
    await page.getByText('Text of the job file').click();
    const text = page.getByRole('textbox', { name: 'Text of the job file' });
    await text.fill((await draft()).text.replace('[[operation]]', '# Cut with care.\n[[operation]] # "first"'));
    await page.getByRole('button', { name: 'Use this text' }).click();
    await expect.poll(async () => (await draft()).text).toContain('# Cut with care.');
    const lines = async (): Promise<string[]> => (await draft()).text.split('\n').filter((line) => line !== '').sort();
    const before = await lines();
    await rows.nth(0).dragTo(rows.nth(1));
    await expect.poll(() => values('kind')).toEqual(['pocket', 'profile']);
    expect(await lines()).toEqual(before);
    const down = rows.nth(0).getByRole('button', { name: /^Move 1\. the window down/ });
    await down.focus();
    await page.keyboard.press('Enter');
    await expect.poll(() => values('kind')).toEqual(['profile', 'pocket']);
    expect(await lines()).toEqual(before);
    expect(await violations(page)).toEqual([]);
    // The part is cut.
    await expect.poll(() => page.getByTestId('job-figures').count(), { timeout: 30_000 }).toBe(2);
    await page.getByRole('button', { name: 'Show the program' }).click();
    await expect.poll(() => page.locator('h2.title').innerText()).toBe('tag-job.ngc');
    await expect.poll(() => page.getByTestId('verdict').innerText()).toMatch(/^(No errors|Has warnings)/);
    await page.getByRole('button', { name: 'Open', exact: true }).click();
    await page.getByRole('button', { name: 'Start', exact: true }).first().click();
    await page.getByRole('dialog').getByRole('button', { name: 'Start' }).click();
    await machine.until((status) => status.state === 'Tool' || status.job?.state === 'running');
    const done = page.getByRole('button', { name: 'Done' }).first();
    await Promise.race([done.click(), machine.until((status) => status.job?.state === 'done')]);
    await machine.until((status) => status.job?.name === 'tag-job.ngc' && status.job.state === 'done');
    expect(errors).toEqual([]);
    await context.close();
    await machine.end();
  });

  it('and its job file are dropped together, and each edit changes one line', async () => {
    const { page, context, errors } = await visit(browser, daemon, 'cam');
    await page.setInputFiles('input[type=file]', [example('jobs/plate.svg'), example('jobs/plate.toml')]);
    await expect.poll(() => page.locator('.job-row').count()).toBe(4);
    const draft = (): Promise<Draft> => daemon.get<Draft>('/cam/job?name=plate.toml');
    const before = (await draft()).text.split('\n');
    await page.getByRole('button', { name: /^2\. Pocket/ }).click();
    const depth = page.getByTestId('job-form').getByRole('textbox', { name: 'Depth', exact: true });
    await depth.fill('-2.5');
    await depth.press('Enter');
    await expect.poll(async () => (await draft()).text.split('\n').filter((line, index) => line !== before[index])).toEqual(['depth = -2.5']);
    await expect.poll(() => page.getByTestId('job-figures').count(), { timeout: 30_000 }).toBe(4);
    expect(await page.locator('.job-row').nth(0).innerText()).toContain('cut as number');
    // The tables beside the operations.
    const field = async (path: string, value: string): Promise<void> => {
      await page.locator(`[data-path="${path}"]`).fill(value);
      await page.locator(`[data-path="${path}"]`).press('Enter');
    };
    const text = async (): Promise<string> => (await draft()).text;
    await page.getByText('Tools: 2').click();
    await field('tool.1.flute_length_mm', '22');
    await expect.poll(text).toMatch(/\[tool\.1\][^[]*flute_length_mm = 22/);
    await page.getByRole('button', { name: 'Add tool T3' }).click();
    await page.locator('[data-path="tool.3.shape"]').selectOption('thread mill');
    await field('tool.3.neck_diameter_mm', '2');
    await expect.poll(text).toMatch(/\[tool\.3\]\s*shape = "thread-mill"\s*diameter_mm = 3\s*neck_diameter_mm = 2/);
    // A tool that an operation uses stays; another one goes.
    const removal = (number: number) => page.getByRole('button', { name: `Remove tool T${number}` });
    expect(await removal(1).getAttribute('aria-disabled')).toBe('true');
    expect(await removal(1).innerText()).toContain('Operations that use it: 1');
    await removal(3).click();
    await expect.poll(text).not.toContain('[tool.3]');
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(text).toContain('neck_diameter_mm = 2');
    await removal(3).click();
    await expect.poll(text).not.toContain('neck_diameter_mm');
    await page.getByText('Clamps: 2').click();
    await field('clamp.2.height', '5.5');
    await page.getByRole('button', { name: 'Remove clamp left clamp' }).click();
    await expect.poll(async () => [(await text()).includes('left clamp'), (await text()).includes('height = 5.5')]).toEqual([false, true]);
    await page.getByText('Whole job').click();
    await page.setInputFiles('input[type=file]', [example('jobs/spacer.svg')]);
    const drawing = page.getByRole('group', { name: 'Drawings' }).getByRole('checkbox', { name: 'spacer.svg' });
    await drawing.check();
    await expect.poll(text).toContain('drawing = ["plate.svg", "spacer.svg"]');
    await drawing.uncheck();
    await expect.poll(text).toContain('drawing = "plate.svg"');
    await page.getByRole('button', { name: 'Remove spacer.svg' }).click();
    await expect.poll(() => drawing.count()).toBe(0);
    await field('job.clearance', '7');
    await expect.poll(text).toContain('clearance = 7');
    await page.getByText('Copies on sheets').click();
    await field('nest.quantity', '2');
    await expect.poll(text).toMatch(/\[nest\]\s*quantity = 2/);
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(text).not.toContain('[nest]');
    expect((await draft()).good).toBe(true);
    expect(await violations(page)).toEqual([]);
    expect(errors).toEqual([]);
    await context.close();
  });
});
