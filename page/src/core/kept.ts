// Signals that outlive the page: kept in the browser, on this computer only.
import { effect, signal, type Signal } from '@preact/signals';

let isKeeping = true;
// From now on choices last as long as the page: an embedded page leaves those of its visitor alone.
export function keepNothing(): void {
  isKeeping = false;
}

// `sound` decides whether a value from an earlier visit is still valid. `formerly`: the name under which an earlier version kept it.
export function kept<T>(name: string, otherwise: T, sound: (value: unknown) => value is T, formerly = name): Signal<T> {
  const key = `passo.${name}`;
  let first = otherwise;
  try {
    const text = localStorage.getItem(key) ?? localStorage.getItem(`passo.${formerly}`);
    const value: unknown = text === null ? undefined : JSON.parse(text);
    if (sound(value)) first = value;
  } catch {
    // A browser that keeps nothing shows the usual.
  }
  const result = signal(first);
  effect(() => {
    const text = JSON.stringify(result.value);
    if (!isKeeping) return;
    try {
      localStorage.setItem(key, text);
    } catch {
      // As above.
    }
  });
  return result;
}

export function oneOf<T extends string>(...values: readonly T[]) {
  return (value: unknown): value is T => values.some((one) => one === value);
}
