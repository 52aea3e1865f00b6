// The queue, the ended jobs and the alarms: with `passo serve --data` alone.
import { signal } from '@preact/signals';
import type { Alarm, HistoryJob } from './api';
import { get, Refused } from './api';

export const queue = signal<HistoryJob[]>([]);
export const ended = signal<HistoryJob[]>([]);
export const alarms = signal<Alarm[]>([]);
// Null: not asked yet.
export const keeps = signal<boolean | null>(null);

export async function refreshHistory(): Promise<void> {
  try {
    queue.value = (await get<{ jobs: HistoryJob[] }>('/queue')).jobs;
    ended.value = (await get<{ jobs: HistoryJob[] }>('/history?most=50')).jobs;
    alarms.value = (await get<{ alarms: Alarm[] }>('/alarms?most=20')).alarms;
    keeps.value = true;
  } catch (error) {
    if (error instanceof Refused && error.code === 'data.none') keeps.value = false;
  }
}
