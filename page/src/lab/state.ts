// The lab's view and its module, as signals. The address follows the view, a little later while something is dragged:
// browsers bound how often an address may change.
import { batch, effect, signal } from '@preact/signals';
import { query, replaceQuery } from '../core/route';
import { LabCore } from './core';
import { type LabView, readView, refusedIn, type RefusedValue, sound, writeView } from './view';

export const view = signal<LabView>(readView(new URLSearchParams()));
export const core = signal<LabCore | undefined>(undefined);
export const coreFailed = signal(false);
export const refused = signal<RefusedValue[]>([]); // what the address asked for and cannot be

// How often an address has been read: a link that comes while its part is shown begins that part anew.
export const arrivals = signal(0);

export function change(what: Partial<LabView>): void {
  refused.value = [];
  follow(what);
}
// What changes by itself, e.g. the board's mode: what was refused of the link is still to be read.
export function follow(what: Partial<LabView>): void {
  view.value = sound({ ...view.value, ...what });
}

// The address of the present view: the address line may be a moment behind.
export function linkToView(): string {
  const address = new URL(location.href);
  const asked = writeView(view.value).toString();
  if (address.hash.startsWith('#')) address.hash = address.hash.split('?')[0] + (asked === '' ? '' : `?${asked}`);
  else address.search = asked;
  return address.href;
}

const writeAfter = 200; // ms

// While the lab is shown. Returns what ends it.
export function followAddress(): () => void {
  let written: string | undefined;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const endReading = effect(() => {
    const text = query.value.toString();
    if (text === written) return;
    written = text;
    refused.value = refusedIn(query.value);
    view.value = readView(query.value);
    arrivals.value = arrivals.peek() + 1;
  });
  const endWriting = effect(() => {
    const wanted = writeView(view.value);
    clearTimeout(timer);
    if (wanted.toString() === written) return;
    timer = setTimeout(() => {
      written = wanted.toString();
      replaceQuery(wanted);
    }, writeAfter);
  });
  return () => {
    endReading();
    endWriting();
    clearTimeout(timer);
  };
}

export async function loadCore(): Promise<void> {
  if (core.value) return;
  try {
    const reply = await fetch(new URL('lab.wasm', document.baseURI));
    if (!reply.ok) throw new Error(reply.statusText);
    const loaded = await LabCore.load(await reply.arrayBuffer());
    batch(() => {
      core.value = loaded;
      coreFailed.value = false;
    });
  } catch {
    coreFailed.value = true;
  }
}
