// The token that a server beyond this computer asks for. It comes once, behind # in the address, which browsers do not
// send: http://mill:7080/#token=… It stays until the tab is closed.
import { signal } from '@preact/signals';

const key = 'passo.token';
export const token = signal('');

export function readToken(): void {
  const given = /^#token=([\w-]+)/.exec(location.hash)?.[1];
  try {
    if (given !== undefined) sessionStorage.setItem(key, given);
    token.value = sessionStorage.getItem(key) ?? given ?? '';
  } catch {
    token.value = given ?? '';
  }
  if (given !== undefined) history.replaceState(null, '', '#/');
}

export function giveToken(text: string): void {
  token.value = text.trim();
  try {
    sessionStorage.setItem(key, token.value);
  } catch {
    // Then it lasts as long as the page.
  }
}
