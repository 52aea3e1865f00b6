// Onto the path of a program, elsewhere than at its beginning: a job that was broken off, and any line. The person sees
// each step before the machine makes it.
import { signal } from '@preact/signals';
import { say } from '../core/language';
import { attempt } from '../core/notices';
import { confirm } from '../core/question';
import { moveAs } from './actions';
import { ask, remove, type Program } from './api';
import { refreshInterrupted, stepsOf, type Interrupted, type Way } from './interrupted';
import { beOwner } from './owner';
import { placeWords } from './place';
import { shown } from './programs';

const patience = 60_000; // ms: the daemon goes through the program up to the line

// A start amid a program that a person is asked about. A line that is done often needs the pass; a point after the line's
// beginning may be named. The daemon tells the way anew after each change.
interface StartAt {
  program: Program;
  line: number;
  pass: number | null;
  after: number; // mm
  way: Way | null; // null: it is being asked for
}
export const startsAt = signal<StartAt | null>(null);
export const noStart = (): void => void (startsAt.value = null);

const queryOf = ({ line, pass, after }: StartAt): string =>
  `from_line=${line}${pass === null ? '' : `&pass=${pass}`}${after > 0 ? `&after=${after}` : ''}`;

async function askWay(wanted: StartAt): Promise<void> {
  startsAt.value = wanted;
  const found = await attempt(async () => {
    const way = (await (await ask('GET', `/programs/${wanted.program.id}/way?${queryOf(wanted)}`, undefined, patience)).json()) as Way;
    if (startsAt.value === wanted) startsAt.value = { ...wanted, way };
  });
  if (!found && startsAt.value === wanted) noStart();
}

export async function startAt(line: number): Promise<void> {
  const program = shown.value;
  if (program !== null) await askWay({ program, line, pass: null, after: 0, way: null });
}

export async function changeStart(to: Partial<Pick<StartAt, 'pass' | 'after'>>): Promise<void> {
  const now = startsAt.value;
  if (now !== null) await askWay({ ...now, ...to, way: null });
}

export async function beginThere(): Promise<void> {
  const now = startsAt.value;
  noStart();
  if (now !== null) await moveAs(`/programs/${now.program.id}/run?${queryOf(now)}`);
}

export async function resumeInterrupted(broken: Interrupted): Promise<void> {
  const yes = await confirm({
    title: say('broken.resume.ask', { name: broken.job.name }),
    facts: [
      say('broken.resume.facts', { line: broken.line ?? 0, place: placeWords(broken.place ?? {}) }),
      say('broken.resume.spindle'),
    ],
    yes: say('broken.resume'),
    kind: 'go',
  });
  if (yes) await moveAs('/interrupted/resume');
}

export async function reenterInterrupted(broken: Interrupted): Promise<void> {
  const yes = await confirm({
    title: say('broken.reenter.ask', { name: broken.job.name }),
    facts: [say('way.what'), say('way.clear')],
    steps: stepsOf(broken.reentry),
    yes: say('broken.reenter'),
    kind: 'go',
  });
  if (yes) await moveAs('/interrupted/reenter');
}

export async function dropInterrupted(broken: Interrupted): Promise<void> {
  const yes = await confirm({
    title: say('broken.drop.ask', { name: broken.job.name }),
    facts: [say('broken.drop.facts')],
    yes: say('broken.drop'),
    kind: 'stop',
  });
  if (!yes) return;
  await attempt(async () => {
    await beOwner();
    await remove('/interrupted');
    await refreshInterrupted();
  });
}
