// The operations of `passo cam` as forms, made of their description (GET /cam/operations). A field that is left empty
// takes the default, which stands in it.
import { computed } from '@preact/signals';
import { isKey, type Key } from '../core/language';
import { fromMm, lengthUnit } from '../core/units';
import { usualClearance, usualDepth } from '../machine/machine_file';
import { operations, type CamOperation, type CamOption } from '../machine/cam';

export interface Field {
  option: string;
  title: Key;
  kind: 'text' | 'flag' | 'choice' | 'file' | 'name'; // name: a file, or a name that may be typed
  usual: string;
  isLength: boolean; // or several, with commas between
  ofMachine: boolean; // the machine file may say otherwise
  ofJob: boolean; // a board decides it itself for the jobs that it needs
  choices: readonly (readonly [string, Key])[];
  without: Key | null; // what counts where nothing is chosen
}
export interface Form {
  job: string;
  title: Key;
  files: string; // what the file dialog offers
  most: number | undefined; // files at once
  withoutFiles: string | undefined; // an option that needs no drawing
  fields: readonly Field[];
  more: readonly Field[]; // that few need
  parts: readonly string[]; // jobs that it needs; their options are those of their own forms
}

// The words of an option, or of one of its choices: those of the operation, or those of all.
function wordsOf(job: string, name: string): Key {
  const own = `cam.${job}.${name}`;
  const common = `cam.option.${name}`;
  if (isKey(own)) return own;
  if (isKey(common)) return common;
  throw new Error(`there are no words for ${own}`);
}

const kinds: Partial<Record<string, Field['kind']>> = { flag: 'flag', choice: 'choice', place: 'choice', file: 'file' };

function fieldOf(job: string, option: string, row: CamOption): Field {
  const kind = row['x-names'] === undefined ? (kinds[row['x-kind']] ?? 'text') : 'name';
  const usual = row.default === undefined ? '' : String(row.default);
  const all = row.enum ?? row.examples ?? [];
  const words = (name: string): Key => wordsOf(job, `${option}.${name}`);
  return {
    option,
    title: wordsOf(job, option),
    kind,
    usual,
    isLength: row['x-kind'] === 'length' || row['x-kind'] === 'feed',
    ofMachine: row['x-of-machine'] === true,
    ofJob: row['x-of-job'] === true,
    choices: all.filter((one) => one !== usual).map((one) => [one, words(one)] as const),
    without: kind === 'choice' || kind === 'file' || kind === 'name' ? words(usual === '' ? 'none' : usual) : null,
  };
}

function formOf(operation: CamOperation): Form {
  const job = operation.title;
  const title = `cam.${job}`;
  if (!isKey(title)) throw new Error(`there are no words for ${title}`);
  const rows = Object.entries(operation.properties);
  const fieldsFor = (whom: CamOption['x-for']): Field[] => rows.filter(([, row]) => row['x-for'] === whom).map(([option, row]) => fieldOf(job, option, row));
  return {
    job,
    title,
    files: operation['x-accepts'],
    most: operation['x-most-files'],
    withoutFiles: operation['x-instead-of-files'],
    fields: fieldsFor(undefined),
    more: fieldsFor('experts'),
    parts: operation['x-parts'] ?? [],
  };
}

export const forms = computed<readonly Form[]>(() => operations.value.map(formOf));

const bare = /^[-+]?(\d+\.?\d*|\.\d+|\d+\/\d+)$/;

// Bare numbers are in the unit of the page. They are sent with it, and keep it where the page shows another one later.
export function withUnit<T extends string | boolean>(field: Field, value: T): T | string {
  if (typeof value !== 'string' || !field.isLength) return value;
  return value
    .split(',')
    .map((one) => (bare.test(one.trim()) ? `${one.trim()}${lengthUnit()}` : one.trim()))
    .join(',');
}
// What the machine file says of it, as it is sent.
export function ofMachine(field: Field): string | undefined {
  const mm = !field.ofMachine ? undefined : field.option === 'clearance' ? usualClearance.value : usualDepth.value;
  return mm === undefined ? undefined : `${mm}mm`;
}
// What counts where nothing is filled in, in the unit of the page.
export function usualOf(field: Field): string {
  const usual = ofMachine(field) ?? field.usual;
  const mm = /^(-?[\d.]+)mm$/.exec(usual)?.[1];
  return mm === undefined || lengthUnit() === 'mm' ? usual : `${Number(fromMm(Number(mm)).toPrecision(3))}${lengthUnit()}`;
}

const kindOf = (name: string): string => (/\.[a-z0-9_]+$/i.exec(name)?.[0] ?? '').toLowerCase();
const takes = (form: Form, kind: string): boolean => kind !== '' && form.files.split(',').includes(kind);

// The form that takes such files: the one at hand if it does. Several files of a board make a whole board, as a zip does.
export function formFor(names: readonly string[], atHand: Form | undefined): Form | undefined {
  const kinds = names.map(kindOf);
  const fits = (form: Form): boolean => kinds.every((kind) => takes(form, kind));
  const several = forms.value.find((form) => form.parts.length > 0 && kinds.length > 1 && fits(form) && kinds.some((kind) => kind !== '.txt'));
  // Where files are only one of the inputs, they lead to another form first: a picture to a relief, not to engraving.
  const byFiles = [...forms.value.filter((form) => form.withoutFiles === undefined), ...forms.value.filter((form) => form.withoutFiles !== undefined)];
  const all = (first: Form | undefined): readonly Form[] => (first === undefined ? byFiles : [first, ...byFiles]);
  return all(several ?? atHand).find(fits) ?? all(atHand).find((form) => takes(form, kinds.at(-1) ?? '')) ?? atHand;
}
// Those of the files that a form takes.
export const taken = (form: Form, names: readonly string[]): string[] => names.filter((name) => takes(form, kindOf(name)));
// Whether a file is a drawing or a picture, and no G-code.
export const isDrawing = (name: string): boolean => kindOf(name) !== '.txt' && forms.value.some((form) => takes(form, kindOf(name)));
