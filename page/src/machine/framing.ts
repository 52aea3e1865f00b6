// Framing: a move around the job, to see where it lies before the cut.
import { attempt } from '../core/notices';
import { askValues, type AskedField } from '../core/question';
import { say } from '../core/language';
import { whyNoSetUp } from './actions';
import { post, type Program } from './api';
import { status } from './connection';
import { beOwner } from './owner';
import { checkedFromHere } from './programs';

const far = 1e4; // mm, as the daemon knows it
const usualFeed = 2000; // mm/min

export const whyNoFrame = (program: Program): string => {
  const why = whyNoSetUp();
  if (why !== '') return why;
  if (status.value?.lost_place === true) return say('state.Idle.unknown');
  return program.state === 'bad' ? say('why.bad') : '';
};

// Nobody has set a zero: the job lies at machine zero.
const isUnset = (): boolean =>
  Object.values(status.value?.work_offset ?? {}).every((value) => value === 0) && (status.value?.work_rotation ?? 0) === 0;

const fields = (): AskedField[] => [
  { name: 'height', title: say('framing.height'), measure: 'length', low: -far, high: far, value: null, usual: say('framing.height.usual') },
  { name: 'clearance', title: say('framing.clearance'), measure: 'length', low: -far, high: far, value: null, usual: say('framing.clearance.usual') },
  { name: 'feed', title: say('framing.feed'), measure: 'speed', low: 1, high: 1e5, value: usualFeed },
];

export async function frameJob(program: Program): Promise<void> {
  const unset = isUnset();
  const values = await askValues({
    title: say('framing.ask', { name: program.name }),
    facts: [say('framing.facts'), ...(unset ? [say('framing.unset')] : [])],
    choices: [{ name: 'shape', title: say('framing.shape'), all: [['extents', say('framing.extents')], ['hull', say('framing.hull')]] }],
    fields: fields(),
    yes: say('framing.do'),
    kind: 'go',
  }); // prettier-ignore
  if (values === null) return;
  await attempt(async () => {
    if ((await checkedFromHere(program.id)) === null) return;
    await beOwner();
    await post(`/programs/${program.id}/frame`, { ...values, ...(unset ? { machine_zero: true } : {}) });
  });
}
