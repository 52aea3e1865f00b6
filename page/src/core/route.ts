// The page that is shown stands behind # in the address: #/run, #/jog. What follows "?" belongs to the page: #/lab?to=9,4.
import { computed, signal } from '@preact/signals';

const hash = signal('');
// What a page was called in version 0.1: links and bookmarks still lead to it for one version.
const formerly: Partial<Record<string, string>> = { make: 'cam' };
const pathIn = (all: string): string => all.split('?')[0] ?? '';
export const path = computed(() => formerly[pathIn(hash.value)] ?? pathIn(hash.value));
export const query = computed(() => new URLSearchParams(hash.value.split('?')[1] ?? ''));

export function followRoute(first: string): void {
  const read = (): void => {
    hash.value = location.hash.replace(/^#\/?/, '') || first;
  };
  addEventListener('hashchange', read);
  read();
}

export function goTo(to: string): void {
  location.hash = `/${to}`;
}

// Changes what follows "?" without a step in the browser's history: for links that reproduce a view.
export function replaceQuery(to: URLSearchParams): void {
  const text = to.toString();
  history.replaceState(null, '', `#/${path.value}${text === '' ? '' : `?${text}`}`);
  hash.value = location.hash.replace(/^#\/?/, '');
}
