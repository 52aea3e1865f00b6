// The tables of a job file beside its operations: the whole job, stock, copies, clamps and tools. The fields of [job] and
// of tools come from the same description as the command line (GET /cam/operations).
import { isKey, say, type Key } from '../core/language';
import { cam, operations as commands, partKinds, toolKeys, type CamOption, type ToolKey } from '../machine/cam';
import { edit, type JobFile, type Value } from '../machine/job_file';
import { Button } from '../parts/button';
import { SelectField, type Choices } from '../parts/select';
import { Typed } from '../parts/typed';
import { forms, type Field } from './cam_forms';
import { drawingsOf, textOf, usersOf, valueOf, withDrawing } from './cam_job_values';

type Table = Record<string, Value> | null | undefined;
const place = { 'x-kind': 'place', type: 'string' };
const length = { 'x-kind': 'length', type: ['string', 'number'] };
const words = { 'x-kind': 'text', type: 'string' };
const number = { 'x-kind': 'number', type: 'number' };

const put = (path: string, value: Value | undefined): void => void edit(value === undefined ? { do: 'unset', path } : { do: 'set', path, value });

interface CellProps {
  table: string; // "tool.1"
  values: Table;
  name: string;
  title: string;
}

function Cell({ table, values, name, title, row, usual = '' }: CellProps & { row: CamOption; usual?: string }) {
  return (
    <label class="form-field">
      <span class="dim">{title}</span>
      <Typed value={textOf(values?.[name])} placeholder={usual} data-path={`${table}.${name}`} take={(typed) => put(`${table}.${name}`, valueOf(row, typed))} />
    </label>
  );
}

// `usual`: the words of the default, which is not in the file.
function ChoiceCell({ table, values, name, title, all, usual }: CellProps & { all: Choices; usual: string | null }) {
  const set = (to: string): void => put(`${table}.${name}`, to === '' ? undefined : to);
  return <SelectField title={title} value={textOf(values?.[name])} all={all} none={usual} data-path={`${table}.${name}`} set={set} />;
}

// `usual`: what counts where the file has nothing.
function FlagCell({ table, values, name, title, usual }: CellProps & { usual: boolean }) {
  return (
    <label class="cam-flag">
      <input type="checkbox" checked={(values?.[name] ?? usual) === true} data-path={`${table}.${name}`} onChange={(event) => put(`${table}.${name}`, event.currentTarget.checked === usual ? undefined : event.currentTarget.checked)} />
      <span>{title}</span>
    </label>
  );
}

// Options that most jobs set once for all of their operations.
const shared = ['for', 'clearance', 'change-height', 'park', 'coolant', 'spindle-delay'];

function SharedOption({ file, field }: { file: JobFile; field: Field }) {
  const row = commands.value.find((one) => one.title === 'profile')?.properties[field.option] ?? words;
  const cell = { table: 'job', values: file.job, name: field.option, title: say(field.title) };
  if (field.kind !== 'choice') return <Cell {...cell} row={row} usual={field.usual} />;
  return <ChoiceCell {...cell} all={field.choices.map(([one, title]) => [one, say(title)] as const)} usual={field.without === null ? '' : say(field.without)} />;
}

// Those that were sent, and those that the file names.
function JobDrawings({ file }: { file: JobFile }) {
  const all = drawingsOf(file);
  const form = forms.value.find((one) => one.job === 'profile');
  const sent = (cam.value?.files ?? []).filter((name) => !name.endsWith('.toml') && form?.files.split(',').some((ending) => name.toLowerCase().endsWith(ending)) === true);
  const names = [...new Set([...all, ...sent])];
  if (names.length === 0) return null;
  return (
    <div role="group" aria-label={say('cam.files')}>
      <span class="dim">{say('cam.files')}</span>
      {names.map((name) => (
        <label key={name} class="cam-flag">
          <input type="checkbox" checked={all.includes(name)} onChange={(event) => put('job.drawing', withDrawing(all, name, event.currentTarget.checked))} />
          <span>{name}</span>
        </label>
      ))}
    </div>
  );
}

export function WholeJob({ file }: { file: JobFile }) {
  const cell = (name: string, title: Key): CellProps => ({ table: 'job', values: file.job, name, title: say(title) });
  const form = forms.value.find((one) => one.job === 'profile');
  const fields = [...(form?.fields ?? []), ...(form?.more ?? [])];
  return (
    <details>
      <summary>{say('job.whole')}</summary>
      <JobDrawings file={file} />
      <div class="form-fields">
        <Cell {...cell('name', 'job.whole.name')} row={words} />
        <Cell {...cell('zero', 'job.whole.zero')} row={place} usual="file" />
        <ChoiceCell {...cell('units', 'job.whole.units')} all={[['cm', 'cm'], ['inch', 'inch']]} usual="mm" />
        <ChoiceCell {...cell('programs', 'job.whole.programs')} all={[['each-tool', say('job.whole.each-tool')]]} usual={say('job.whole.one')} />
        <ChoiceCell {...cell('order', 'job.whole.order')} all={[['as-written', say('job.whole.as-written')]]} usual={say('job.whole.by-tool')} />
        {shared.map((option) => {
          const field = fields.find((one) => one.option === option);
          return field === undefined ? null : <SharedOption key={option} file={file} field={field} />;
        })}
      </div>
    </details>
  );
}

export function Stock({ file }: { file: JobFile }) {
  const cell = (name: string, title: Key): CellProps => ({ table: 'stock', values: file.stock, name, title: say(title) });
  return (
    <details>
      <summary>{say('job.stock')}</summary>
      <div class="form-fields">
        <Cell {...cell('size', 'job.stock.size')} row={place} />
        <Cell {...cell('thickness', 'job.stock.thickness')} row={length} />
        <Cell {...cell('corner', 'job.stock.corner')} row={place} usual="0, 0" />
        <Cell {...cell('material', 'job.stock.material')} row={words} />
      </div>
    </details>
  );
}

// The stock is then a sheet. A table without a quantity is an error, so an empty field means one copy.
export function Nest({ file }: { file: JobFile }) {
  const cell = (name: string, title: Key): CellProps => ({ table: 'nest', values: file.nest, name, title: say(title) });
  return (
    <details>
      <summary>{say('job.nest')}</summary>
      <p class="dim">{say('job.nest.sheet')}</p>
      <div class="form-fields">
        <label class="form-field">
          <span class="dim">{say('cam.option.quantity')}</span>
          <Typed value={textOf(file.nest?.quantity)} placeholder="1" inputMode="numeric" data-path="nest.quantity" take={(typed) => (typed.trim() !== '' || file.nest !== null) && put('nest.quantity', valueOf(number, typed) ?? 1)} />
        </label>
        {file.nest !== null && (
          <>
            <Cell {...cell('rotations', 'cam.option.rotations')} row={number} usual="4" />
            <Cell {...cell('gap', 'cam.profile.gap')} row={length} />
            <Cell {...cell('margin', 'cam.option.nest-margin')} row={length} />
          </>
        )}
      </div>
    </details>
  );
}

export function Clamps({ file }: { file: JobFile }) {
  const written = file.clamp_paths.filter((path) => path.startsWith('clamp.')).length;
  return (
    <details>
      <summary>{say('job.clamps', { count: file.clamps.length })}</summary>
      {file.clamps.map((values, index) => {
        const table = file.clamp_paths[index]!;
        const [list, number] = table.split('.') as [string, string];
        const title = textOf(values.name) || `${index + 1}`;
        const cell = (name: string, key: Key): CellProps => ({ table, values, name, title: say(key) });
        return (
          <fieldset key={table} class="job-table">
            <legend>{title}</legend>
            <div class="form-fields">
              <Cell {...cell('name', 'job.clamp.name')} row={words} />
              <Cell {...cell('from', 'job.clamp.from')} row={place} />
              <Cell {...cell('to', 'job.clamp.to')} row={place} />
              <Cell {...cell('height', 'job.clamp.height')} row={length} />
            </div>
            <Button icon="trash" onClick={() => edit({ do: 'remove', list, number: Number(number) })}>
              {say('job.clamp.remove', { name: title })}
            </Button>
          </fieldset>
        );
      })}
      <Button icon="plus" onClick={() => edit({ do: 'insert', list: 'clamp', number: written + 1, values: { from: [0, 0], to: [10, 10], height: 10 } })}>
        {say('job.clamp.add')}
      </Button>
    </details>
  );
}

const keyTitle = (key: ToolKey): string => say(`job.tool.${key.key}` as Key);
const choiceTitle = (key: ToolKey, one: string): string => (isKey(`job.tool.${key.key}.${one}`) ? say(`job.tool.${key.key}.${one}` as Key) : one);

function ToolCell({ row, table, values }: { row: ToolKey; table: string; values: Table }) {
  const cell = { table, values, name: row.key, title: keyTitle(row) };
  if (row.kind === 'flag') return <FlagCell {...cell} usual />;
  if (row.kind === 'choice') {
    const all = (row.choices ?? []).map((one) => [one, choiceTitle(row, one)] as const);
    return <ChoiceCell {...cell} all={row.needed ? all : all.slice(1)} usual={row.needed ? null : all[0]![1]} />;
  }
  return <Cell {...cell} row={row.kind === 'text' ? words : number} />;
}

function RemoveTool({ file, number }: { file: JobFile; number: string }) {
  const keys = ['tool', ...partKinds.value.map((kind) => kind.first_tool).filter((key) => key !== '')];
  const users = usersOf(file, Number(number), keys);
  return (
    <Button icon="trash" why={users.length === 0 ? '' : say('job.tool.used', { operations: users.join(', ') })} onClick={() => edit({ do: 'remove', path: `tool.${number}` })}>
      {say('job.tool.remove', { number })}
    </Button>
  );
}

// Tools of the library are shown by their numbers only: they belong to all jobs.
export function Tools({ file }: { file: JobFile }) {
  const own = Object.entries(file.tool_tables ?? {}).filter((entry): entry is [string, Record<string, Value>] => typeof entry[1] === 'object' && entry[1] !== null && !Array.isArray(entry[1]));
  const others = file.tools.filter((tool) => !own.some(([one]) => Number(one) === tool.number));
  const next = Math.max(0, ...own.map(([one]) => Number(one) || 0), ...file.tools.map((tool) => tool.number)) + 1;
  return (
    <details>
      <summary>{say('job.tools', { count: own.length + others.length })}</summary>
      {own.map(([one, values]) => (
        <fieldset key={one} class="job-table">
          <legend>{`T${one}`}</legend>
          <div class="form-fields">
            {toolKeys.value
              .filter((row) => row.shapes.length === 0 || row.shapes.includes(textOf(values.shape)))
              .map((row) => (
                <ToolCell key={row.key} row={row} table={`tool.${one}`} values={values} />
              ))}
          </div>
          <RemoveTool file={file} number={one} />
        </fieldset>
      ))}
      {others.length > 0 && <p class="dim">{say('job.tools.library', { tools: others.map((tool) => tool.words).join('; ') })}</p>}
      <Button icon="plus" onClick={() => edit({ do: 'set', path: `tool.${next}.shape`, value: 'flat' }, { do: 'set', path: `tool.${next}.diameter_mm`, value: 3 })}>
        {say('job.tool.add', { number: next })}
      </Button>
    </details>
  );
}
