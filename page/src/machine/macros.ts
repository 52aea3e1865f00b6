// Macros: small programs of the server's folder. Each asks for its values before it runs, and for a confirmation.
import { effect, signal } from '@preact/signals';
import { attempt, notify } from '../core/notices';
import { asked, askValues, type AskedField } from '../core/question';
import { say } from '../core/language';
import { moveAs, whyNoSetUp } from './actions';
import { get, type Finding } from './api';
import { isLive } from './connection';

export interface MacroValue {
  name: string;
  title: string;
  unit: string;
  low: number;
  high: number;
  whole: boolean;
  default: number | null; // null: it is needed
}
export interface Macro {
  name: string;
  title: string;
  key: string; // F1 to F12; empty: none
  values: MacroValue[];
}
export const macros = signal<Macro[]>([]);
export const macroFindings = signal<Finding[]>([]);

export const refreshMacros = (): Promise<boolean> =>
  attempt(async () => {
    const answer = await get<{ macros: Macro[]; findings: Finding[] }>('/macros');
    macros.value = answer.macros;
    macroFindings.value = answer.findings;
  });

// Their keys work on each page.
export function followMacros(): void {
  effect(() => {
    if (isLive.value) void refreshMacros();
  });
}

const measures: Record<string, AskedField['measure']> = { mm: 'length', 'mm/min': 'speed' };
export const fieldOf = (one: MacroValue): AskedField => ({
  name: one.name,
  title: one.title,
  measure: measures[one.unit] ?? 'plain',
  unit: one.unit,
  low: one.low,
  high: one.high,
  whole: one.whole,
  value: one.default,
});

export async function runMacro(macro: Macro): Promise<void> {
  const values = await askValues({
    title: say('macro.ask', { title: macro.title }),
    facts: [say('macro.facts')],
    fields: macro.values.map(fieldOf),
    yes: say('macro.run'),
    kind: 'go',
  });
  if (values !== null) await moveAs('/macros', { name: macro.name, values });
}

// A function key of a macro opens its question. Keys of an open question are its own.
export function onMacroKey(event: Pick<KeyboardEvent, 'key' | 'shiftKey' | 'preventDefault'>): boolean {
  const macro = macros.value.find((one) => one.key !== '' && one.key === event.key);
  if (macro === undefined || event.shiftKey || asked.value !== null) return false;
  event.preventDefault();
  const why = whyNoSetUp();
  if (why === '') void runMacro(macro);
  else notify('refused', why);
  return true;
}
