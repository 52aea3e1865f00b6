// The machine file as a guided table. Nothing counts before it is written, and what is written counts when passo serve
// starts again.
import { Fragment } from 'preact';
import { useEffect } from 'preact/hooks';
import { language, say, type Key } from '../core/language';
import { reportWords } from '../core/faults';
import { confirm } from '../core/question';
import { fromMm, isRotary, lengthUnit, perLength, smallUnit, toMm, units } from '../core/units';
import { whyNot } from '../machine/actions';
import { isLive, machine, status } from '../machine/connection';
import {
  canUndo, changes, draft, file, isChanged, lastChanged, loadFile, scaleOf, setValue, takeText, undo, values, writeFile, type Value,
} from '../machine/machine_file';
import { Button } from '../parts/button';
import { FileChoice } from '../parts/file_choice';
import { Icon } from '../parts/icon';
import { RowHead } from '../parts/row_head';
import { Select } from '../parts/select';
import { Typed } from '../parts/typed';

interface Row {
  title: Key;
  key: string; // of lengths; a rotary axis has the other
  rotary?: string;
  unit?: string; // after the length's unit
  kind: 'plain' | 'length' | 'per length' | 'flag' | 'choice';
  at?: number; // of a list
  choices?: readonly string[];
}
function unitOf({ kind, unit = '' }: Row): string {
  if (kind === 'length') return lengthUnit() + unit;
  return kind === 'per length' ? `1/${lengthUnit()}` : '';
}
const rows: readonly Row[] = [
  { title: 'file.turn', key: 'steps_per_turn', kind: 'plain' },
  { title: 'file.micro', key: 'microsteps', kind: 'plain' },
  { title: 'file.pitch', key: 'screw_pitch_mm', rotary: 'gear_ratio', kind: 'length' },
  { title: 'file.direct', key: 'steps_per_mm', rotary: 'steps_per_deg', kind: 'per length' },
  { title: 'machine.from', key: 'travel_mm', rotary: 'travel_deg', kind: 'length', at: 0 },
  { title: 'machine.to', key: 'travel_mm', rotary: 'travel_deg', kind: 'length', at: 1 },
  { title: 'machine.speed', key: 'max_velocity_mm_s', rotary: 'max_velocity_deg_s', kind: 'length', unit: '/s' },
  { title: 'machine.acceleration', key: 'max_acceleration_mm_s2', rotary: 'max_acceleration_deg_s2', kind: 'length', unit: '/s²' },
  { title: 'file.jerk', key: 'max_jerk_mm_s3', rotary: 'max_jerk_deg_s3', kind: 'length', unit: '/s³' },
  { title: 'file.inverted', key: 'inverted', kind: 'flag' },
  { title: 'file.motor', key: 'motor', kind: 'plain' },
  { title: 'file.home', key: 'home.direction', kind: 'choice', choices: ['low', 'high'] },
  { title: 'file.home.at', key: 'home.switch_at_mm', rotary: 'home.switch_at_deg', kind: 'length' },
  { title: 'file.home.seek', key: 'home.seek_mm_s', rotary: 'home.seek_deg_s', kind: 'length', unit: '/s' },
  { title: 'file.home.latch', key: 'home.latch_mm_s', rotary: 'home.latch_deg_s', kind: 'length', unit: '/s' },
  { title: 'file.home.off', key: 'home.pull_off_mm', rotary: 'home.pull_off_deg', kind: 'length' },
  { title: 'file.home.input', key: 'home.input', kind: 'plain' },
];
// Of the work, whatever the axis.
const ofWork: readonly [string, Key][] = [['work.clearance_mm', 'file.clearance'], ['work.depth_mm', 'file.depth']];
const guided = (path: string): boolean => path.startsWith('work.') || /^axis\.[A-Z]\./.test(path) && rows.some((row) => [row.key, row.rotary].includes(path.slice(7)));

// Inches have as many digits as their millimetres need.
const digits = (value: number): string => String(Number(value.toPrecision(units.value === 'inch' ? 6 : 9)));
const readNumber = (text: string): number | undefined => {
  const plain = text.trim().replace(',', '.');
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : undefined;
};

interface FieldProps {
  label: string;
  path: string;
  kind: Row['kind'];
  at?: number | undefined;
  choices?: readonly string[] | undefined;
}
function Field({ label, path, kind, at, choices }: FieldProps) {
  const whole = values.value[path];
  const value = at !== undefined && Array.isArray(whole) ? whole[at] : whole;
  const set = (to: Value): void => {
    if (at === undefined) return void setValue(path, to);
    const list = Array.isArray(whole) ? [...whole] : [0, 0];
    list[at] = Number(to);
    void setValue(path, list);
  };
  const isWrong = draft.value?.good === false && lastChanged.value === path;
  const shared = { 'aria-label': label, 'aria-invalid': isWrong, 'data-path': path } as const;
  if (kind === 'flag' || typeof value === 'boolean') {
    return <input type="checkbox" {...shared} checked={value === true} onChange={(event) => set(event.currentTarget.checked)} />;
  }
  if (kind === 'choice') {
    const all = (choices ?? []).map((one) => [one, say(one === 'low' ? 'file.low' : 'file.high')] as const);
    return <Select {...shared} value={typeof value === 'string' ? value : ''} all={all} none="–" set={(to) => to !== '' && set(to)} />;
  }
  if (typeof value === 'string') {
    return <Typed {...shared} value={value} take={set} />;
  }
  const shown = kind === 'length' ? fromMm : kind === 'per length' ? perLength : (one: number) => one;
  const read = kind === 'length' ? toMm : kind === 'per length' ? fromMm : (one: number) => one;
  const text = Array.isArray(value) ? value.join(', ') : value === undefined ? '' : digits(shown(value));
  return (
    <Typed
      inputMode="decimal"
      {...shared}
      value={text}
      placeholder="–"
      take={(typed) => {
        if (Array.isArray(value)) {
          const list = typed.split(',').map((one) => readNumber(one));
          if (list.every((one) => one !== undefined)) set(list);
        } else {
          const number = readNumber(typed);
          if (number !== undefined) set(Number(read(number).toPrecision(9)));
        }
      }}
    />
  );
}

function AxesTable({ axes }: { axes: readonly string[] }) {
  return (
    <div class="wide-table editor" tabIndex={0} role="region" aria-label={say('file.axes')}>
      <table>
        <thead>
          <tr>
            <th scope="col">{say('machine.axis')}</th>
            {axes.map((axis) => (
              <th scope="col" key={axis} class="axis-head" data-axis={axis.toLowerCase()}>
                {axis}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.map((row, i) => (
            <Fragment key={row.title}>
              <tr>
                <RowHead title={say(row.title)} unit={unitOf(row)} />
                {axes.map((axis) => {
                  const rotary = isRotary(axis.toLowerCase());
                  return (
                    <td key={axis}>
                      <Field
                        label={`${axis} ${say(row.title)}`}
                        path={`axis.${axis}.${rotary ? (row.rotary ?? row.key) : row.key}`}
                        kind={rotary && row.kind.endsWith('length') ? 'plain' : row.kind}
                        at={row.at}
                        choices={row.choices}
                      />
                    </td>
                  );
                })}
              </tr>
              {i === 3 && <ScaleRow axes={axes} />}
            </Fragment>
          ))}
        </tbody>
      </table>
    </div>
  );
}

// The arithmetic, as a person would do it.
function ScaleRow({ axes }: { axes: readonly string[] }) {
  return (
    <tr class="scale">
      <RowHead title={say('file.scale')} unit={say('file.steps.unit', { unit: lengthUnit() })} />
      {axes.map((axis) => {
        const rotary = isRotary(axis.toLowerCase());
        const scale = scaleOf(values.value, axis, rotary, (mm) => digits(fromMm(mm)));
        if (scale === undefined) return <td key={axis}>–</td>;
        return (
          <td key={axis} data-testid={`scale-${axis}`}>
            <span class="dim">{scale.words} =</span> <b>{digits(rotary ? scale.steps : perLength(scale.steps))}</b>
            <br />
            <span class="dim">{say('file.one', { step: rotary ? `${(1 / scale.steps).toPrecision(3)}°` : `${(1000 / perLength(scale.steps)).toPrecision(3)} ${smallUnit()}` })}</span>
          </td>
        );
      })}
    </tr>
  );
}

function Work() {
  return (
    <div class="form-fields editor">
      {ofWork.map(([path, title]) => (
        <label key={path} class="form-field">
          <span class="dim">
            {say(title)} {lengthUnit()}
          </span>
          <Field label={say(title)} path={path} kind="length" />
        </label>
      ))}
    </div>
  );
}

function Others() {
  const paths = Object.keys(values.value).filter((path) => !guided(path));
  return (
    <details>
      <summary>{say('file.others', { count: paths.length })}</summary>
      <table class="facts editor">
        <tbody>
          {paths.map((path) => (
            <tr key={path}>
              <th scope="row">
                <code>{path}</code>
              </th>
              <td>
                <Field label={path} path={path} kind="plain" />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}

const wordsOf = (value: Value | undefined): string =>
  value === undefined ? '–' : Array.isArray(value) ? value.join(' … ') : String(value);

async function write(): Promise<void> {
  const yes = await confirm({
    title: say('file.write.ask', { name: file.value?.name ?? '' }),
    facts: [say('file.write.facts'), say('file.write.when')],
    rows: changes.value.map(([path, before, after]) => [path, `${wordsOf(before)} → ${wordsOf(after)}`]),
    yes: say('file.write'),
    kind: 'go',
  });
  if (yes) await writeFile();
}

function download(): void {
  const url = URL.createObjectURL(new Blob([draft.value?.text ?? ''], { type: 'application/toml' }));
  const link = document.createElement('a');
  link.href = url;
  link.download = /\.toml$/.test(file.value?.name ?? '') ? (file.value?.name ?? '') : 'machine.toml';
  link.click();
  URL.revokeObjectURL(url);
}

function Findings() {
  const now = draft.value;
  if (now === null || now.good) return null;
  const lines = now.text.split('\n');
  return (
    <div class="refusal" role="alert">
      <Icon name="warn" />
      <div>
        <strong>{say('file.refused')}</strong>
        <ul>
          {now.findings.map((one) => (
            <li key={`${one.line} ${one.message}`}>
              {reportWords(one.message, one.message_sentence)}. {reportWords(one.expected, one.expected_sentence)} <code class="dim">{one.code}</code>
              {one.line > 0 && <code class="finding-line">{`${one.line}: ${lines[one.line - 1] ?? ''}`}</code>}
            </li>
          ))}
        </ul>
      </div>
    </div>
  );
}

export function MachineEditor() {
  useEffect(() => {
    if (isLive.value && file.value === null) void loadFile();
  }, [isLive.value]);
  const known = file.value;
  const now = draft.value;
  if (known === null || now === null) return null;
  void [units.value, language.value];
  const moves = isLive.value && !['Idle', 'Alarm', 'Sleep'].includes(status.value?.state ?? '') ? whyNot('Idle') : '';
  const why = isLive.value ? moves : say('why.lost');
  const axes = [...new Set(Object.keys(values.value).flatMap((path) => /^axis\.([A-Z])\./.exec(path)?.[1] ?? []))];
  const whyWrite = !known.writable
    ? say('file.none')
    : !isChanged.value
      ? say('file.same')
      : now.good
        ? whyNot('Idle')
        : say('file.refused');
  return (
    <section class="panel machine-file" aria-label={say('file.title')}>
      <h2 class="title">
        {say('file.title')}: {known.name}
      </h2>
      <p class="dim">{say('file.what')}</p>
      {!known.in_force && (
        <p class="refusal" role="status">
          <Icon name="warn" /> <span>{say('file.later')}</span>
        </p>
      )}
      <div class="row">
        <Button kind="accent" icon="done" why={whyWrite} onClick={write}>
          {say('file.write')}
        </Button>
        <Button icon="reset" why={canUndo.value ? why : say('file.undo.none')} onClick={undo}>
          {say('file.undo')}
        </Button>
        <Button icon="reset" why={why} onClick={loadFile}>
          {say('file.load')}
        </Button>
        <Button icon="files" onClick={download}>
          {say('file.out')}
        </Button>
        <FileChoice label={say('file.in')} accept=".toml" take={async ([one]) => one !== undefined && takeText(await one.text())}>
          {(choose) => (
            <Button icon="upload" why={why} onClick={choose}>
              {say('file.in')}
            </Button>
          )}
        </FileChoice>
      </div>
      <Findings />
      {axes.length > 0 && <AxesTable axes={axes} />}
      {axes.length > 0 && <Work />}
      {axes.length > 0 && <Others />}
      <details>
        <summary>{say('file.text')}</summary>
        <pre class="toml" lang="en" tabIndex={0}>
          {now.text}
        </pre>
      </details>
      {machine.value === null && <p class="dim">{say('why.lost')}</p>}
    </section>
  );
}
