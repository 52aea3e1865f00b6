// A machine file from the configuration of another controller.
import type { CheckFinding } from './answer';
import type { ChosenMachine } from './examples';
import type { FromWorker, ImportName, ImportRequest, ToWorker } from './messages';
import { decoded, mostSourceBytes, treeOfXml, treeOfYaml } from './source_tree';

interface ImportAnswer {
  good: boolean;
  format: ImportName | null;
  findings: CheckFinding[];
  controller?: string;
  toml?: string;
  understood?: number;
  assumed?: { target: string; reason: string }[];
  unmapped?: { source: string; value: string; reason: string; line: number }[];
  warnings?: string[];
}

// By the name of the file; the module looks at the content. A program may have any name, so a dump of settings is known
// by its lines.
const settingsLine = /^\s*\$\d+ *=/m;
export const isConfiguration = (name: string): boolean => /\.(ya?ml|ini|xml)$/i.test(name);
export async function isSettingsDump(file: File): Promise<boolean> {
  return file.size <= mostSourceBytes && settingsLine.test(await file.slice(0, 4096).text());
}

function ask(module: ArrayBuffer, newWorker: () => Worker, request: ImportRequest): Promise<ImportAnswer> {
  return new Promise((done, fail) => {
    const worker = newWorker();
    worker.onerror = () => fail(new Error('the worker has failed'));
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      worker.terminate();
      if (data.kind === 'imported') done(JSON.parse(data.answer) as ImportAnswer);
      else fail(new Error(data.kind === 'failed' ? data.words : data.kind));
    };
    worker.postMessage({ kind: 'import', module, request } satisfies ToWorker);
  });
}

// Throws an error with a message if no machine can be made from the file.
export async function importMachine(file: File, module: ArrayBuffer, newWorker: () => Worker): Promise<ChosenMachine> {
  if (file.size > mostSourceBytes) throw new Error(`${file.name}: the file has more than 1 MiB`);
  const text = decoded(await file.arrayBuffer());
  const request: ImportRequest = { file: file.name, text, format: '' };
  let answer = await ask(module, newWorker, request);
  if (answer.format === 'fluidnc' || answer.format === 'mach3') {
    const tree = answer.format === 'fluidnc' ? treeOfYaml(text) : treeOfXml(text);
    answer = await ask(module, newWorker, { ...request, format: answer.format, tree });
  }
  if (answer.format === null) throw new Error(`${file.name}: this is not a configuration of Grbl, grblHAL, FluidNC, LinuxCNC or Mach3`);
  if (!answer.good || answer.toml === undefined) {
    throw new Error(answer.findings.map((one) => `${file.name}${one.line > 0 ? `:${one.line}` : ''}: ${one.message}; expected: ${one.expected}`).join('\n') || file.name);
  }
  return {
    file: file.name,
    text: answer.toml,
    own: true,
    imported: {
      controller: answer.controller ?? '',
      understood: answer.understood ?? 0,
      assumed: (answer.assumed ?? []).map((one) => `${one.target}: ${one.reason}`),
      unmapped: (answer.unmapped ?? []).map((one) => `${one.source} = ${one.value}${one.reason === '' ? '' : `: ${one.reason}`}`),
      warnings: answer.warnings ?? [],
    },
  };
}
