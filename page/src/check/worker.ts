// The check in a thread of its own, so that the page answers and a check can be ended at once.
import { CheckModule, type HostFile } from './host';
import type { FromWorker, ToWorker } from './messages';

const say = (what: FromWorker, handed: Transferable[] = []): void => (self as unknown as DedicatedWorkerScope).postMessage(what, handed);
interface DedicatedWorkerScope {
  postMessage: (what: FromWorker, handed: Transferable[]) => void;
}

const reader = new (self as unknown as { FileReaderSync: new () => { readAsArrayBuffer: (blob: Blob) => ArrayBuffer } }).FileReaderSync();
const hostFile = (file: File): HostFile => ({
  size: file.size,
  read: (from, size) => new Uint8Array(reader.readAsArrayBuffer(file.slice(from, from + size))),
});

const betweenReports = 60; // ms
let module: CheckModule | undefined;
let told = 0;

async function check(order: Extract<ToWorker, { kind: 'check' }>): Promise<void> {
  const begun = performance.now();
  module = await CheckModule.start(order.module, (stage, share) => {
    const now = performance.now();
    if (share > 0 && now - told < betweenReports) return;
    told = now;
    say({ kind: 'progress', stage, share });
  });
  for (const file of order.files) module.addFile(file.name, hostFile(file));
  const answer = module.check(order.request);
  say({ kind: 'done', answer, milliseconds: performance.now() - begun, bytes: module.bytes });
}

self.onmessage = async ({ data }: MessageEvent<ToWorker>): Promise<void> => {
  try {
    if (data.kind === 'check') {
      await check(data);
    } else if (data.kind === 'import') {
      const importer = await CheckModule.start(data.module, () => undefined);
      say({ kind: 'imported', answer: importer.import(data.request) });
    } else {
      const bytes = module?.path(data.first, data.count, data.level).buffer ?? new ArrayBuffer(0);
      say({ kind: 'path', id: data.id, bytes }, [bytes]);
    }
  } catch (error) {
    // The module ends by a trap where memory() cannot grow.
    const full = error instanceof RangeError || (error instanceof WebAssembly.RuntimeError && (module?.bytes ?? 0) > nearlyAll);
    say({ kind: 'failed', memory: full, words: String(error) });
  }
};
const nearlyAll = 900 * 2 ** 20;
