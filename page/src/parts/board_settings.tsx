// The settings of the Grbl board: shown with names, units, ranges and meaning, written one by one, saved as a file, compared
// with one and restored from one. What the board says of them is English.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { say, sayCount } from '../core/language';
import { attempt } from '../core/notices';
import { confirm } from '../core/question';
import { whyNot } from '../machine/actions';
import { isLive } from '../machine/connection';
import {
  byGroup, compareWith, edit, edited, edits, forgetEdits, hasBit, isWorking, learnSettings, rangeOf, readSettings, restoreFrom, settings, settingsFile,
  sought, told, unitOf, withBit, writeEdits, type Change, type Difference, type Setting,
} from '../machine/board_settings';
import { opened } from '../machine/ports';
import { Button } from './button';
import { FactsTable } from './facts_table';
import { FileChoice } from './file_choice';
import { Icon } from './icon';
import { Select } from './select';
import { Typed } from './typed';

const search = signal('');
const compared = signal<{ file: string; name: string; rows: Difference[] } | null>(null);

const why = (): string => (isWorking.value ? say('settings.works') : whyNot('Idle', 'Alarm'));
const shown = (value: string): string => (value === '' ? '–' : value);

function Field({ setting }: { setting: Setting }) {
  const value = edits.value[setting.name] ?? setting.value;
  const label = `${setting.name} ${setting.title}`;
  const set = (to: string): void => edit(setting.name, to);
  if (setting.read_only) return <code>{shown(value)}</code>;
  if (setting.kind === 'flag') {
    return <input type="checkbox" aria-label={label} checked={Number(value) !== 0} onChange={(event) => set(event.currentTarget.checked ? '1' : '0')} />;
  }
  if (setting.kind === 'choice') {
    const all = setting.choices.map((words, i) => [String(i), words === '' ? String(i) : words] as const);
    return <Select aria-label={label} value={value} all={all.filter(([one], i) => setting.choices[i] !== '' || one === value)} set={set} />;
  }
  if (setting.kind === 'bits' || setting.kind === 'axes') {
    return (
      <fieldset class="setting-bits" aria-label={label}>
        {setting.choices.map((words, i) =>
          words === '' ? null : (
            <label key={i}>
              <input type="checkbox" checked={hasBit(value, i)} onChange={(event) => set(withBit(value, i, event.currentTarget.checked))} />
              <span>{words}</span>
            </label>
          ),
        )}
      </fieldset>
    );
  }
  const isNumber = setting.kind === 'number' || setting.kind === 'integer';
  return <Typed {...(isNumber ? { inputMode: 'decimal' as const } : {})} aria-label={label} value={value} take={(typed) => set(isNumber ? typed.trim().replace(',', '.') : typed.trim())} />;
}

function Row({ setting }: { setting: Setting }) {
  const isEdited = edits.value[setting.name] !== undefined && edits.value[setting.name] !== setting.value;
  const range = rangeOf(setting);
  return (
    <tr class={isEdited ? 'edited' : ''} data-setting={setting.name}>
      <th scope="row">
        <code>{setting.name}</code>
      </th>
      <td lang="en">
        {setting.title === '' ? say('settings.undescribed') : setting.title}
        {setting.meaning !== '' && <span class="dim setting-meaning">{setting.meaning}</span>}
        {setting.needs_restart && <span class="dim setting-meaning">{say('settings.restart')}</span>}
      </td>
      <td class="setting-value">
        <Field setting={setting} /> <span class="unit">{unitOf(setting)}</span>
        {range !== '' && <span class="dim setting-meaning">{range}</span>}
        {isEdited && <span class="setting-meaning">{say('settings.before', { value: shown(setting.value) })}</span>}
      </td>
    </tr>
  );
}

function Table() {
  const found = sought(settings.value, search.value);
  return (
    <>
      <label class="form-field settings-search">
        <span class="dim">{say('settings.search')}</span>
        <input type="text" value={search.value} onInput={(event) => (search.value = event.currentTarget.value)} />
      </label>
      <p class="dim" role="status">
        {sayCount('settings.count', found.length)}
      </p>
      {byGroup(found).map(([group, rows]) => (
        <section key={group} aria-label={group === '' ? say('settings.title') : group}>
          {group !== '' && <h3 lang="en">{group}</h3>}
          <table class="settings">
            <tbody>
              {rows.map((one) => (
                <Row key={one.name} setting={one} />
              ))}
            </tbody>
          </table>
        </section>
      ))}
    </>
  );
}

function Changes({ changes }: { changes: readonly Change[] }) {
  if (changes.length === 0) return null;
  return (
    <ul class="setting-changes" role="status" aria-label={say('settings.changes')}>
      {changes.map((one) => (
        <li key={one.name} class={one.written ? '' : 'refusal'}>
          <Icon name={one.written ? 'calm' : 'warn'} />
          <span>
            {one.written ? (
              say('settings.written', { name: one.name, before: shown(one.before), value: shown(one.value) })
            ) : (
              <>
                {say('settings.unwritten', { name: one.name, value: shown(one.value) })} <span lang="en">{one.trouble}</span>
              </>
            )}
            {one.also.map((words) => (
              <span key={words} class="dim setting-meaning" lang="en">
                {say('settings.also')} {words}
              </span>
            ))}
          </span>
        </li>
      ))}
    </ul>
  );
}

const rowsOf = (differences: readonly Difference[]): string[][] => differences.map((one) => [one.name, shown(one.file), shown(one.board)]);
const columns = (): string[] => [say('settings.in.file'), say('settings.on.board')];

function Compared() {
  const now = compared.value;
  if (now === null) return null;
  return (
    <div class="compared" role="status">
      <p>{now.rows.length === 0 ? say('settings.same', { name: now.name }) : sayCount('settings.differ', now.rows.length, { name: now.name })}</p>
      {now.rows.length > 0 && <FactsTable columns={columns()} rows={rowsOf(now.rows)} shown={(name) => <code>{name}</code>} />}
      {now.rows.length > 0 && (
        <Button icon="reset" why={why()} onClick={() => restore(now.name, now.file, now.rows)}>
          {say('settings.restore')} …
        </Button>
      )}
    </div>
  );
}

async function write(): Promise<void> {
  const yes = await confirm({
    title: say('settings.write.ask'),
    facts: [say('settings.write.facts')],
    columns: [say('settings.on.board'), say('settings.new')],
    rows: edited.value.map((one) => [`${one.name} ${one.title}`, shown(one.value), shown(edits.value[one.name] ?? '')]),
    yes: say('settings.write'),
    kind: 'go',
  });
  if (yes) await writeEdits();
}

async function compare(name: string, file: string): Promise<void> {
  compared.value = null;
  const rows = await compareWith(file);
  if (rows !== null) compared.value = { file, name, rows };
}

async function restore(name: string, file: string, rows: readonly Difference[]): Promise<void> {
  const both = rows.filter((one) => one.file !== '' && one.board !== '');
  const yes = await confirm({
    title: say('settings.restore.ask', { name }),
    facts: [say('settings.write.facts')],
    columns: columns(),
    rows: rowsOf(both),
    yes: say('settings.restore'),
    kind: 'go',
  });
  if (!yes) return;
  compared.value = null;
  forgetEdits();
  await restoreFrom(file);
}

async function save(): Promise<void> {
  await attempt(async () => {
    const url = URL.createObjectURL(new Blob([await settingsFile()], { type: 'text/plain' }));
    const link = document.createElement('a');
    link.href = url;
    link.download = 'settings.txt';
    link.click();
    URL.revokeObjectURL(url);
  });
}

export function BoardSettings() {
  const contact = opened.value?.state;
  useEffect(() => {
    if (isLive.value) void learnSettings();
  }, [isLive.value, contact]);
  const now = told.value;
  if (now === null || !now.has_board) return null;
  const isRead = settings.value.length > 0;
  const whyWrite = edited.value.length === 0 ? say('settings.unchanged') : why();
  return (
    <section class="panel board-settings" aria-label={say('settings.title')}>
      <h2 class="title">
        {say('settings.title')}
        {now.report !== null && `: ${now.report.firmware} ${now.report.version}`}
      </h2>
      <p class="dim">{say('settings.what')}</p>
      <div class="row">
        <Button kind={isRead ? 'plain' : 'accent'} icon="reset" why={why()} onClick={readSettings}>
          {say('settings.read')}
        </Button>
        {isRead && (
          <>
            <Button kind="accent" icon="done" why={whyWrite} onClick={write}>
              {say('settings.write')}
            </Button>
            <Button icon="reset" why={edited.value.length === 0 ? say('settings.unchanged') : ''} onClick={forgetEdits}>
              {say('settings.forget')}
            </Button>
            <Button icon="files" why={isLive.value ? '' : say('why.lost')} onClick={save}>
              {say('settings.save')}
            </Button>
            <FileChoice label={say('settings.compare')} take={async ([one]) => one !== undefined && compare(one.name, await one.text())}>
              {(choose) => (
                <Button icon="upload" why={why()} onClick={choose}>
                  {say('settings.compare')}
                </Button>
              )}
            </FileChoice>
          </>
        )}
      </div>
      {now.state === 'running' && <p role="status">{say('settings.works')}</p>}
      {now.state === 'failed' && (
        <pre class="toml failed" lang="en" role="alert" tabIndex={0}>
          {now.words}
        </pre>
      )}
      <Changes changes={now.report?.changes ?? []} />
      <Compared />
      {isRead && <Table />}
    </section>
  );
}
