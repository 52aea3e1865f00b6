// The set-up mode of the outputs: a program that does nothing but wait, so that the outputs can be switched by hand. It
// ends by Stop or Done, and then all outputs are off.
import { computed } from '@preact/signals';
import { attempt } from '../core/notices';
import { post } from './api';
import { moveAs } from './actions';
import { status } from './connection';
import { runLine } from './console';
import { setUpName } from './programs';

const patience = 5000; // ms
const lookEvery = 50; // ms

export const isSetUp = computed(() => {
  const now = status.value;
  return now !== null && now.job?.name === setUpName && now.job.state === 'running' && now.waits_for_operator;
});

export type Turn = 'off' | 'clockwise' | 'counterclockwise';

async function until(what: () => boolean): Promise<void> {
  for (const end = performance.now() + patience; !what() && performance.now() < end; ) {
    await new Promise((resolve) => setTimeout(resolve, lookEvery));
  }
}

export async function endSetUp(): Promise<void> {
  await attempt(() => post('/stop'));
  await until(() => status.value?.state === 'Idle');
}

// Begins the mode, or goes on in it with the spindle as wanted.
export async function setUp(turn: Turn = 'off', speed = 0): Promise<void> {
  const { mist = false, flood = false } = isSetUp.value ? (status.value?.outputs ?? {}) : {};
  if (isSetUp.value) await endSetUp();
  const spindle = turn === 'off' ? '' : `${turn === 'clockwise' ? 'M3' : 'M4'} S${speed}\n`;
  if (!(await runLine(`${spindle}M0\nM2`, setUpName))) return;
  await until(() => isSetUp.value);
  if (mist || flood) await moveAs('/outputs', { mist, flood });
}
