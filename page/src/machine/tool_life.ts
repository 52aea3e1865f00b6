// The tools of the machine: what each has cut, and what its life allows.
import { signal } from '@preact/signals';
import { attempt } from '../core/notices';
import { confirm } from '../core/question';
import { say } from '../core/language';
import { beOwner } from './owner';
import { get, post } from './api';

export interface MachineTool {
  number: number;
  name: string; // empty: unknown
  pocket: number | null; // of the tool table; null: not in it
  length_mm: number | null;
  cut_mm: number;
  cut_s: number;
  life_mm: number | null; // null: no limit
  life_s: number | null;
  replaced_at: number | null; // seconds since 1970
}
export interface MachineTools {
  counts: boolean;
  tools: MachineTool[];
}
export const machineTools = signal<MachineTools | null>(null);

export const refreshTools = (): Promise<boolean> =>
  attempt(async () => {
    machineTools.value = await get<MachineTools>('/tools');
  });

// The used part of the life, whichever limit is nearer. null: there is no limit.
export function usedShare(tool: MachineTool): number | null {
  const shares = [tool.life_mm === null ? [] : [tool.cut_mm / tool.life_mm], tool.life_s === null ? [] : [tool.cut_s / tool.life_s]].flat();
  return shares.length > 0 ? Math.max(...shares) : null;
}

const oneDecimal = (value: number): string => value.toFixed(1);
export function cutWords({ cut_mm, life_mm }: MachineTool): string {
  const cut = oneDecimal(cut_mm / 1000);
  return life_mm === null ? say('toollife.metres', { cut }) : say('toollife.metres.of', { cut, life: oneDecimal(life_mm / 1000) });
}
export function timeWords({ cut_s, life_s }: MachineTool): string {
  const time = oneDecimal(cut_s / 60);
  return life_s === null ? say('toollife.minutes', { time }) : say('toollife.minutes.of', { time, life: oneDecimal(life_s / 60) });
}

export async function replaceTool(tool: MachineTool): Promise<void> {
  const yes = await confirm({
    title: say('toollife.ask', { tool: tool.number }),
    facts: [say('toollife.facts', { cut: cutWords(tool), time: timeWords(tool) })],
    yes: say('toollife.yes'),
    kind: 'go',
  });
  if (!yes) return;
  await attempt(async () => {
    await beOwner();
    machineTools.value = await post<MachineTools>(`/tools/${tool.number}/replaced`);
  });
}
