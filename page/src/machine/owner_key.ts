// The key of the ownership of motion, if this page has it, and which ownership it is for: others may have the same name. It
// outlives a reload of the tab, and nothing else.
import { effect, signal } from '@preact/signals';

const place = 'passo.owner-key';
const takenPlace = 'passo.owner-taken';
export const ownerKey = signal('');
export const ownerTaken = signal(0);

export function rememberOwnerKey(): void {
  try {
    ownerKey.value = sessionStorage.getItem(place) ?? '';
    ownerTaken.value = Number(sessionStorage.getItem(takenPlace));
    effect(() => {
      sessionStorage.setItem(place, ownerKey.value);
      sessionStorage.setItem(takenPlace, String(ownerTaken.value));
    });
  } catch {
    // A reload then asks for the ownership again.
  }
}
