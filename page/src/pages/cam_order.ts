// What is to be made: the job, its drawings, and what was filled in. It outlives a look at another page.
import { signal } from '@preact/signals';
import { kept } from '../core/kept';
import { cam, needOperations, order, refreshCam, sendDrawing, type Options } from '../machine/cam';
import { forgetShapes, jobFile, openJobFile } from '../machine/job_file';
import { formFor, forms, ofMachine, taken, withUnit, type Field, type Form } from './cam_forms';

type Values = Record<string, string | boolean>;
const isTable = (value: unknown): value is Record<string, Values> => typeof value === 'object' && value !== null;
// What was filled in, by job.
const filled = kept<Record<string, Values>>('cam', {}, isTable, 'make');
export const job = signal('');
export const picked = signal<readonly string[]>([]);
// What a person says of a board's files, by their names: 'top copper'.
export const layers = signal<Readonly<Record<string, string>>>({});

// A page that comes anew shows what was made last.
let isNew = true;
export async function lookAtCam(): Promise<void> {
  await Promise.all([refreshCam(), needOperations()]);
  const last = cam.value?.job ?? '';
  if (isNew && picked.value.length === 0 && forms.value.some((one) => one.job === last)) job.value = last;
  isNew = false;
}

export const valuesOf = (form: Form): Values => filled.value[form.job] ?? {};
// Undefined: the operations are not known yet.
export const formNow = (): Form | undefined => forms.value.find((one) => one.job === job.value) ?? forms.value[0];
export const fieldsOf = (form: Form): readonly Field[] => [...form.fields, ...form.more];
// The forms whose fields belong to this one: what a board needs.
export const partsOf = (form: Form): readonly Form[] => form.parts.flatMap((name) => forms.value.find((one) => one.job === name) ?? []);

const filledIn = (value: string | boolean | undefined): string | boolean | undefined => (typeof value === 'string' ? value.trim() : value);

function optionsOf(form: Form, without: (field: Field) => boolean = () => false): Options {
  const values = valuesOf(form);
  const all = fieldsOf(form).filter((field) => !without(field)).map((field) => [field, filledIn(values[field.option]) || ofMachine(field)] as const);
  return Object.fromEntries(all.flatMap(([field, value]) => (value === undefined ? [] : [[field.option, withUnit(field, value)]])));
}

export function ask(form: Form | undefined): void {
  if (form === undefined) return;
  const options = optionsOf(form);
  if (form.job === jobForm) return jobFile.value?.good === true ? order({ job: form.job, files: [jobFile.value.name], options }) : undefined;
  // Letters need no drawing, and have none.
  const hasText = form.withoutFiles !== undefined && options[form.withoutFiles] !== undefined;
  // What a field names is no drawing: a board's edge, a font.
  const named = fieldsOf(form).filter((field) => field.kind === 'file' || field.kind === 'name').map((field) => options[field.option]);
  const files = hasText ? [] : taken(form, picked.value).filter((one) => !named.includes(one)).slice(0, form.most);
  if (files.length === 0 && !hasText) return;
  if (form.parts.length === 0) return order({ job: form.job, files, options });
  const known = new Set(cam.value?.job === form.job ? cam.value.report?.files.map((one) => one.name) : []);
  const told = Object.entries(layers.value).filter(([name]) => known.has(name));
  const profile = Object.fromEntries(partsOf(form).map((part) => [part.job, optionsOf(part, (field) => field.ofJob)]));
  order({ job: form.job, files, options: { ...options, as: told.map(([name, layer]) => `${name}=${layer}`) }, profile });
}

export function set(form: Form, option: string, value: string | boolean): void {
  filled.value = { ...filled.value, [form.job]: { ...valuesOf(form), [option]: value } };
  ask(formNow());
}

export function setLayer(name: string, layer: string): void {
  layers.value = { ...layers.value, [name]: layer };
  ask(formNow());
}

// A job file with its operations and drawings, as a list (cam_job.tsx).
export const jobForm = 'job';
const isJobFile = async (file: File): Promise<boolean> => file.name.endsWith('.toml') && /^\s*(\[\[\s*"?operation\b|operation\s*=)/m.test(await file.text());

function takeForm(names: readonly string[]): void {
  job.value = formFor(names, formNow())?.job ?? job.value;
}

export function pick(name: string, isPicked: boolean): void {
  picked.value = isPicked ? [...picked.value, name] : picked.value.filter((one) => one !== name);
  if (isPicked) takeForm([name]);
  ask(formNow());
}

// A drawing that the job at hand cannot use leads to the first one that can. Several files of a board make one.
export async function takeDrawings(files: readonly File[]): Promise<void> {
  for (const file of files) {
    forgetShapes(file.name);
    await sendDrawing(file);
  }
  for (const file of files) {
    if (!(await isJobFile(file))) continue;
    job.value = jobForm;
    await openJobFile(file.name);
  }
  if (formNow()?.job === jobForm) return;
  const known = new Set(cam.value?.files ?? []);
  const names = files.map((file) => file.name).filter((name) => known.has(name));
  if (files.length > 0) takeForm(files.map((file) => file.name));
  const form = formNow();
  if (form === undefined) return;
  if (form.parts.length > 0) picked.value = [...new Set([...picked.value, ...names])];
  else if (picked.value.length === 0) picked.value = (cam.value?.files ?? []).slice(-(form.most ?? 1));
  ask(form);
}
