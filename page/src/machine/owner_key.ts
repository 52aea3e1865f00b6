// The key of the ownership of motion, if this page has it. It outlives a reload of the tab, and nothing else.
import { effect, signal } from '@preact/signals';

const place = 'passo.owner-key';
const nameKey = 'passo.page-name';
export const ownerKey = signal('');

export function rememberOwnerKey(): void {
  try {
    ownerKey.value = sessionStorage.getItem(place) ?? '';
    effect(() => sessionStorage.setItem(place, ownerKey.value));
  } catch {
    // A reload then asks for the ownership again.
  }
}

let name = '';

// Tells this tab from others: a short number that lasts as long as the tab.
export function pageName(): string {
  if (name !== '') return name;
  name = `page ${Math.floor(Math.random() * 9000) + 1000}`;
  try {
    name = sessionStorage.getItem(nameKey) ?? name;
    sessionStorage.setItem(nameKey, name);
  } catch {
    // Then a reload is another page.
  }
  return name;
}
