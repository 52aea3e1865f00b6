// What is to be made: the job, its drawings, and what was filled in. It outlives a look at another page.
import { signal } from '@preact/signals';
import { kept } from '../core/kept';
import { make, order, sendDrawing } from '../machine/maker';
import { formFor, forms, type Form } from './make_forms';

type Values = Record<string, string | boolean>;
const isTable = (value: unknown): value is Record<string, Values> => typeof value === 'object' && value !== null;
// What was filled in, by job.
const filled = kept<Record<string, Values>>('make', {}, isTable);
export const job = signal(forms[0].job);
export const picked = signal<readonly string[]>([]);

export const valuesOf = (form: Form): Values => filled.value[form.job] ?? {};
export const formNow = (): Form => forms.find((one) => one.job === job.value) ?? forms[0];

export function ask(form: Form): void {
  const options = Object.fromEntries(Object.entries(valuesOf(form)).filter(([, value]) => value !== '' && value !== false));
  // Letters need no drawing, and have none.
  const hasText = form.withoutFiles !== undefined && options[form.withoutFiles] !== undefined;
  // What a field names is no drawing: a board's edge, a font.
  const named = form.fields.filter((field) => field.kind === 'file').map((field) => options[field.option]);
  const files = hasText ? [] : picked.value.filter((one) => !named.includes(one));
  if (files.length > 0 || hasText) order({ job: form.job, files, options });
}

export function set(form: Form, option: string, value: string | boolean): void {
  filled.value = { ...filled.value, [form.job]: { ...valuesOf(form), [option]: value } };
  ask(form);
}

// A drawing that the job at hand cannot use leads to the first one that can.
export async function takeDrawings(files: readonly File[]): Promise<void> {
  for (const file of files) await sendDrawing(file);
  const last = files.at(-1);
  if (last !== undefined) job.value = formFor(last.name, formNow()).job;
  const known = make.value?.files ?? [];
  if (picked.value.length === 0) picked.value = known.slice(-1);
  ask(formNow());
}
