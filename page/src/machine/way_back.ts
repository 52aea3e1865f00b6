// Onto the path of a program, elsewhere than at its beginning: a job that was broken off, and any line. The person sees
// each step before the machine makes it.
import { say } from '../core/language';
import { attempt, notify } from '../core/notices';
import { confirm } from '../core/question';
import { moveAs } from './actions';
import { ask, remove } from './api';
import { refreshInterrupted, type Interrupted, type Way } from './interrupted';
import { beOwner } from './owner';
import { placeWords } from './place';
import { shown } from './programs';

const patience = 60_000; // ms: the daemon goes through the program up to the line

export async function startAt(line: number): Promise<void> {
  const program = shown.value;
  if (program === null) return;
  let way: Way | undefined;
  const found = await attempt(async () => {
    way = (await (await ask('GET', `/programs/${program.id}/way?from_line=${line}`, undefined, patience)).json()) as Way;
  });
  if (!found || way === undefined) return;
  if (way.code !== '') return notify('refused', say('way.none', { line, why: way.why }));
  const yes = await confirm({
    title: say('way.ask', { name: program.name, line: way.line ?? line }),
    facts: [say('way.what'), say('way.clear')],
    steps: way.steps,
    yes: say('do.start'),
    kind: 'go',
  });
  if (yes) await moveAs(`/programs/${program.id}/run?from_line=${line}`);
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
    steps: broken.reentry.steps,
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
