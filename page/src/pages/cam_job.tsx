// The operations of a job file as a list, and the form of the one at hand.
import { useEffect, useState } from 'preact/hooks';
import { isKey, say, type Key } from '../core/language';
import { lengthText, lengthUnit } from '../core/units';
import { durationText } from '../core/time';
import type { Finding } from '../machine/api';
import { cam, operations as commands, partKinds, type PartKind } from '../machine/cam';
import { isLive } from '../machine/connection';
import { edit, jobFile, newJobFile, openJobFile, past, replaceText, undo, type CutOperation, type JobFile, type JobOperation, type JobReport, type Value } from '../machine/job_file';
import { Button } from '../parts/button';
import { Reported } from '../parts/reported';
import { SelectField, type Choices } from '../parts/select';
import { Typed } from '../parts/typed';
import { forms, type Field } from './cam_forms';
import { current, hovered } from './cam_job_picture';
import { Clamps, Nest, Stock, Tools, WholeJob } from './cam_job_tables';
import { drawingsOf, findingsOf, ownerOf, selectors, textOf, valueOf, wanted } from './cam_job_values';

const kindTitle = (kind: string): string => (isKey(`job.kind.${kind}`) ? say(`job.kind.${kind}` as Key) : kind);
const path = (index: number, key: string): string => `operation.${index + 1}.${key}`;

function setKey(index: number, key: string, value: Value | undefined): void {
  void edit(value === undefined ? { do: 'unset', path: path(index, key) } : { do: 'set', path: path(index, key), value });
}
function move(index: number, to: number): void {
  current.value = to;
  void edit({ do: 'move', number: index + 1, to: to + 1 });
}

// What the last run tells of an operation, if it is still the same one.
function cutOf(operation: JobOperation, index: number): { cut: CutOperation; place: number } | null {
  const now = cam.value;
  if (now === null || now.job !== 'job' || now.state !== 'done') return null;
  const report = now.report as unknown as JobReport | null;
  const place = report?.operations.findIndex((one) => one.written === index + 1) ?? -1;
  const cut = report?.operations[place];
  return cut === undefined || cut.line !== operation.lines.kind || cut.kind !== operation.values.kind ? null : { cut, place };
}

// "plate.toml:52:1: error: ..." and errors in the program, which name the title of their operation.
interface Said {
  line: number; // of the job file; 0: an error in the program
  words: string;
}
function saidOf(file: JobFile, index: number): Said[] {
  if (cam.value?.job !== 'job' || cam.value.state !== 'failed') return [];
  const title = file.operations[index]?.values.title;
  return cam.value.words.split('\n').flatMap((words) => {
    const found = /^(.*?):(\d+)(?::\d+)?: error: (.*)$/.exec(words);
    if (found === null) return [];
    const isOfFile = found[1] === file.name;
    const isOwn = isOfFile ? ownerOf(file, Number(found[2])) === index : typeof title === 'string' && words.includes(`'${title}'`);
    return isOwn && !file.findings.some((one) => words.includes(one.message)) ? [{ line: isOfFile ? Number(found[2]) : 0, words: found[3]! }] : [];
  });
}

function Errors({ findings, said = [] }: { findings: readonly Finding[]; said?: readonly Said[] }) {
  if (findings.length + said.length === 0) return null;
  return (
    <ul class="job-errors">
      {findings.map((one) => (
        <li key={`${one.line} ${one.message}`}>
          {one.line > 0 && <b>{say('job.line', { line: one.line })}: </b>}
          <Reported words={one.message} sentence={one.message_sentence} code={one.code} />
          {one.expected !== '' && (
            <>
              {' '}
              (<Reported words={one.expected} sentence={one.expected_sentence} />)
            </>
          )}
        </li>
      ))}
      {said.map(({ line, words }) => (
        <li key={words}>
          {line > 0 && <b>{say('job.line', { line })}: </b>}
          <span lang="en">{words}</span>
        </li>
      ))}
    </ul>
  );
}

const leftOf = (cut: CutOperation): string =>
  [cut.stock_left_mm3 === undefined ? '' : `${Math.round(cut.stock_left_mm3 / 100) / 10} cm³`, cut.stock_left_percent === undefined ? '' : `${cut.stock_left_percent.toFixed(1)} %`]
    .filter((one) => one !== '')
    .join(', ');

function Figures({ operation, index }: { operation: JobOperation; index: number }) {
  const found = cutOf(operation, index);
  if (found === null) return null;
  const { cut, place } = found;
  const seconds = cut.cut_s + (cut.rapid_mm / 3000) * 60;
  const left = leftOf(cut);
  return (
    <p class="job-cut" data-testid="job-figures">
      <span>{say('job.figure.time', { time: durationText(seconds) })}</span> <span>{say('job.figure.depth', { depth: `${lengthText(cut.depth_mm)} ${lengthUnit()}` })}</span>{' '}
      {left !== '' && <span>{say('job.figure.left', { left })}</span>}{' '}
      {place !== index && (
        <span>
          {say('job.figure.place', { place: place + 1 })}
          {cut.reason !== '' && <span lang="en">: {cut.reason}</span>}
        </span>
      )}
    </p>
  );
}

function Row({ file, index }: { file: JobFile; index: number }) {
  const operation = file.operations[index]!;
  const { values } = operation;
  const [over, setOver] = useState(false);
  const title = typeof values.title === 'string' ? values.title : kindTitle(String(values.kind ?? ''));
  const selected = selectors.flatMap((by) => wanted(operation, by)).join(', ');
  const depth = values.depth ?? file.job?.depth;
  const last = index + 1 === file.operations.length;
  const why = file.editable ? '' : say('job.uneditable');
  const name = `${index + 1}. ${title}`;
  return (
    <li
      class={`job-row ${index === current.value ? 'chosen' : ''} ${over ? 'over' : ''}`}
      draggable={file.editable}
      onDragStart={(event) => event.dataTransfer?.setData('text/x-passo-operation', String(index))}
      onDragOver={(event) => {
        if (event.dataTransfer?.types.includes('text/x-passo-operation') !== true) return;
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={(event) => {
        setOver(false);
        const from = event.dataTransfer?.getData('text/x-passo-operation') ?? '';
        if (from === '') return;
        event.preventDefault();
        if (Number(from) !== index) move(Number(from), index);
      }}
      onMouseEnter={() => (hovered.value = index)}
      onMouseLeave={() => (hovered.value = null)}
    >
      <button type="button" class="job-open" aria-pressed={index === current.value} onClick={() => (current.value = index)} onFocus={() => (hovered.value = index)} onBlur={() => (hovered.value = null)}>
        <b>{name}</b>
        <span class="dim">
          {[typeof values.title === 'string' ? kindTitle(String(values.kind ?? '')) : '', values.tool === undefined ? '' : `T${textOf(values.tool)}`, selected === '' ? say('job.all') : selected, depth === undefined ? '' : say('job.figure.depth', { depth: textOf(depth) })]
            .filter((one) => one !== '')
            .join(' · ')}
        </span>
      </button>
      <span class="job-buttons">
        <Button icon="up" label={say('job.up', { name })} why={why || (index === 0 ? say('job.first') : '')} onClick={() => move(index, index - 1)} />
        <Button icon="up" class="job-down" label={say('job.down', { name })} why={why || (last ? say('job.last') : '')} onClick={() => move(index, index + 1)} />
        <Button icon="plus" label={say('job.copy', { name })} why={why} onClick={() => edit({ do: 'copy', number: index + 1 }).then(() => (current.value = index + 1))} />
        <Button icon="trash" label={say('job.remove', { name })} why={why || (file.operations.length === 1 ? say('job.only') : '')} onClick={() => edit({ do: 'remove', number: index + 1 }).then(() => (current.value = Math.max(0, Math.min(current.value, file.operations.length - 2))))} />
      </span>
      <Figures operation={operation} index={index} />
      <Errors findings={findingsOf(file, index)} said={saidOf(file, index)} />
    </li>
  );
}

interface KeyProps {
  file: JobFile;
  index: number;
  name: string;
  title: string;
}
// Whether a finding is about this key.
const isWrong = ({ file, index, name }: KeyProps): boolean => {
  const line = file.operations[index]?.lines[name];
  if (line === undefined) return false;
  return file.findings.some((one) => one.line === line && one.severity === 'error') || saidOf(file, index).some((one) => one.line === line);
};

function TextKey({ placeholder = '', read, ...key }: KeyProps & { placeholder?: string; read: (typed: string) => Value | undefined }) {
  return (
    <label class="form-field">
      <span class="dim">{key.title}</span>
      <Typed value={textOf(key.file.operations[key.index]?.values[key.name])} placeholder={placeholder} aria-invalid={isWrong(key)} take={(typed) => setKey(key.index, key.name, read(typed))} />
    </label>
  );
}

function ChoiceKey({ all, none, read = (typed) => typed, ...key }: KeyProps & { all: Choices; none: string | null; read?: (typed: string) => Value }) {
  const value = textOf(key.file.operations[key.index]?.values[key.name]);
  const set = (to: string): void => setKey(key.index, key.name, to === '' ? undefined : read(to));
  return <SelectField title={key.title} value={value} all={all} none={none} aria-invalid={isWrong(key)} set={set} />;
}

function OptionKey({ field, kind, file, index }: { field: Field; kind: PartKind; file: JobFile; index: number }) {
  const row = commands.value.find((one) => one.title === kind.command)?.properties[field.option];
  const ofJob = file.job?.[field.option];
  const key = { file, index, name: field.option, title: say(field.title) };
  if (field.kind === 'flag') {
    const own = file.operations[index]?.values[field.option];
    return (
      <label class="cam-flag">
        <input
          type="checkbox"
          checked={(own ?? ofJob) === true}
          onChange={(event) => setKey(index, field.option, event.currentTarget.checked === (ofJob === true) ? undefined : event.currentTarget.checked)}
        />
        <span>{key.title}</span>
      </label>
    );
  }
  const usual = ofJob === undefined ? field.usual : textOf(ofJob);
  if (field.kind === 'text') return <TextKey {...key} placeholder={usual} read={(typed) => valueOf(row, typed)} />;
  const sent = field.kind === 'choice' ? [] : (cam.value?.files ?? []).map((name) => [name, name] as const);
  const none = ofJob !== undefined ? textOf(ofJob) : field.without === null ? '' : say(field.without);
  return <ChoiceKey {...key} none={none} all={[...field.choices.map(([one, title]) => [one, say(title)] as const), ...sent]} read={(typed) => valueOf(row, typed) ?? typed} />;
}

function OperationForm({ file, index }: { file: JobFile; index: number }) {
  const operation = file.operations[index];
  if (operation === undefined) return null;
  const kind = partKinds.value.find((one) => one.kind === operation.values.kind);
  const form = forms.value.find((one) => one.job === kind?.command);
  const fits = (field: Field): boolean => kind?.options.includes(field.option) === true;
  const tools = file.tools.map((tool) => [String(tool.number), tool.words] as const);
  const key = (name: string, title: string): KeyProps => ({ file, index, name, title });
  const known = new Set(['kind', 'tool', 'title', kind?.first_tool, kind?.file, 'at', ...(kind?.options ?? [])]);
  const unknown = Object.keys(operation.values).filter((name) => !known.has(name));
  const text = (typed: string): Value | undefined => (typed.trim() === '' ? undefined : typed.trim());
  const sent = (cam.value?.files ?? []).map((name) => [name, name] as const);
  const tool = { all: tools, read: Number };
  return (
    <section class="panel job-form" aria-label={say('job.form', { operation: index + 1 })} data-testid="job-form">
      <h2>{say('job.form', { operation: index + 1 })}</h2>
      <div class="form-fields">
        <ChoiceKey {...key('kind', say('job.kind'))} none={null} all={partKinds.value.map((one) => [one.kind, kindTitle(one.kind)] as const)} />
        {tools.length > 0 ? <ChoiceKey {...key('tool', say('job.tool'))} none={null} {...tool} /> : <TextKey {...key('tool', say('job.tool'))} read={(typed) => valueOf({ 'x-kind': 'number', type: 'number' }, typed)} />}
        {kind !== undefined && kind.first_tool !== '' && <ChoiceKey {...key(kind.first_tool, say('job.first-tool'))} none={say('job.none')} {...tool} />}
        <TextKey {...key('title', say('job.title'))} read={text} />
        {kind !== undefined && kind.kind !== 'face' && <ChoiceKey {...key(kind.file, say('job.drawing'))} none={kind.file === 'drawing' ? drawingsOf(file).join(', ') : ''} all={sent} />}
        {kind?.has_place === true && <TextKey {...key('at', say('job.at'))} read={(typed) => valueOf({ 'x-kind': 'place', type: 'string' }, typed)} />}
        {form?.fields.filter(fits).map((field) => <OptionKey key={field.option} field={field} kind={kind!} file={file} index={index} />)}
      </div>
      {form !== undefined && form.more.some(fits) && (
        <details>
          <summary>{say('cam.more')}</summary>
          <div class="form-fields">
            {form.more.filter(fits).map((field) => (
              <OptionKey key={field.option} field={field} kind={kind!} file={file} index={index} />
            ))}
          </div>
        </details>
      )}
      {unknown.length > 0 && <p class="dim">{say('job.unknown', { keys: unknown.join(', ') })}</p>}
      <p class="dim">{say('job.units', { unit: textOf(file.job?.units) || 'mm' })}</p>
    </section>
  );
}

function JobText({ file }: { file: JobFile }) {
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <details open={!file.editable}>
      <summary>{say('job.text')}</summary>
      <textarea class="job-text" lang="en" spellcheck={false} aria-label={say('job.text')} value={typed ?? file.text} onInput={(event) => setTyped(event.currentTarget.value)} />
      <div class="row">
        <Button icon="done" why={typed === null || typed === file.text ? say('job.text.same') : ''} onClick={() => replaceText(typed ?? file.text).then((good) => good && setTyped(null))}>
          {say('job.text.take')}
        </Button>
        <a class="button plain" href={`data:application/toml;charset=utf-8,${encodeURIComponent(file.text)}`} download={file.name}>
          {say('job.download')}
        </a>
      </div>
    </details>
  );
}

function JobChoice() {
  const files = cam.value?.files ?? [];
  const jobs = files.filter((name) => name.endsWith('.toml'));
  const form = forms.value.find((one) => one.job === 'profile');
  const drawings = files.filter((name) => !name.endsWith('.toml') && form?.files.split(',').some((ending) => name.toLowerCase().endsWith(ending)) === true);
  const why = isLive.value ? '' : say('why.lost');
  // A page that comes anew.
  useEffect(() => {
    if (jobFile.value === null && jobs.length === 1) void openJobFile(jobs[0]!);
  }, [jobs.join('\n')]);
  return (
    <>
      {jobs.length > 0 && <SelectField title={say('job.file')} value={jobFile.value?.name ?? ''} all={jobs.map((name) => [name, name] as const)} none={say('job.none')} set={(to) => to !== '' && openJobFile(to)} />}
      <div class="row">
        {drawings.map((name) => (
          <Button key={name} icon="plus" why={why} onClick={() => newJobFile(name, files)}>
            {say('job.new', { name })}
          </Button>
        ))}
      </div>
      {files.length === 0 && <p class="dim">{say('job.drop')}</p>}
    </>
  );
}

export function JobPanels() {
  const file = jobFile.value;
  const count = file?.operations.length ?? 0;
  useEffect(() => {
    if (count > 0 && current.value >= count) current.value = count - 1;
  }, [count]);
  const others = file?.findings.filter((one) => ownerOf(file, one.line) < 0) ?? [];
  const tool = file?.tools[0]?.number ?? 1;
  return (
    <>
      <section class="panel" aria-label={say('job.operations')}>
        <div class="position-head">
          <h2>{say('job.operations')}</h2>
          {file !== null && (
            <Button icon="reset" why={past.value.length === 0 ? say('job.undo.none') : ''} onClick={undo}>
              {say('job.undo')}
            </Button>
          )}
        </div>
        <JobChoice />
        {file !== null && (
          <>
            <Errors findings={others} />
            <ol class="job-list">
              {file.operations.map((_, index) => (
                <Row key={index} file={file} index={index} />
              ))}
            </ol>
            <Button
              icon="plus"
              why={file.editable ? '' : say('job.uneditable')}
              onClick={() => edit({ do: 'insert', number: count + 1, values: { kind: 'pocket', tool, depth: -2 } }).then((good) => good && (current.value = count))}
            >
              {say('job.add')}
            </Button>
            {file.editable && (
              <>
                <WholeJob file={file} />
                <Stock file={file} />
                <Nest file={file} />
                <Clamps file={file} />
                <Tools file={file} />
              </>
            )}
            <JobText key={file.name} file={file} />
          </>
        )}
      </section>
      {file !== null && file.editable && <OperationForm key={`${file.name} ${current.value}`} file={file} index={current.value} />}
    </>
  );
}
