// Who may move the machine: one client at a time. This page takes the ownership when its person first wants motion.
import { batch, computed, effect, untracked } from '@preact/signals';
import { headers, post, remove } from './api';
import { connection, status, tell } from './connection';
import { ownerKey, ownerTaken } from './owner_key';
import { pageName } from './page_name';

export type Ownership = 'mine' | 'free' | 'other';

export const ownership = computed<Ownership>(() => {
  const owner = status.value?.owner;
  if (owner === undefined || owner.kind === 'nobody') return 'free';
  return owner.kind === 'client' && ownerKey.value !== '' && owner.taken === ownerTaken.value ? 'mine' : 'other';
});

export async function takeOwnership(): Promise<void> {
  const { key, taken } = await post<{ key: string; taken: number }>('/owner', { name: pageName() });
  batch(() => {
    ownerKey.value = key;
    ownerTaken.value = taken;
  });
  stayOwner();
}

// Binds the ownership to the connection. A page that dies without a word then owns the motion for some seconds only.
function stayOwner(): void {
  if (ownerKey.value !== '') tell('/owner/renew');
}
effect(() => {
  if (connection.value === 'live') untracked(stayOwner);
});

// Before a request that moves.
export async function beOwner(): Promise<void> {
  if (ownership.value !== 'mine') await takeOwnership();
}

export async function giveUpOwnership(): Promise<void> {
  await remove('/owner');
  ownerKey.value = '';
}

// A page that goes gives back what nobody moves with. A job keeps its owner: another page takes over.
export function giveBackAtTheEnd(): void {
  addEventListener('pagehide', () => {
    if (ownership.value !== 'mine' || status.value?.state !== 'Idle' || (status.value.waits ?? null) !== null) return;
    void fetch('api/v1/owner', { method: 'DELETE', headers: headers(), keepalive: true }).catch(() => undefined);
    ownerKey.value = '';
  });
}

export const mayMove = computed(() => connection.value === 'live' && ownership.value !== 'other');
