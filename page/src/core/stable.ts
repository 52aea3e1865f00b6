// Values that are the same as before are told to nobody: the daemon's status comes many times a second, and most of it
// has not changed.
import { computed, type ReadonlySignal } from '@preact/signals';

export function stable<T>(make: () => T): ReadonlySignal<T> {
  let before: T | undefined;
  let words = '';
  return computed(() => {
    const now = make();
    const said = JSON.stringify(now);
    if (before !== undefined && said === words) return before;
    words = said;
    before = now;
    return now;
  });
}
