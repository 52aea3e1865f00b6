// What a board has said of itself, and the machine file made of it, before and after it is saved.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { notify } from '../core/notices';
import { whyNot } from '../machine/actions';
import { fileNameFor, keepMachine, keptMachine, opened, type NewMachine as Made } from '../machine/ports';
import { Button } from './button';
import { Icon } from './icon';
import { Typed } from './typed';

const fileName = signal('');

function download(text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: 'application/toml' }));
  const link = document.createElement('a');
  link.href = url;
  link.download = fileName.value;
  link.click();
  URL.revokeObjectURL(url);
}

async function copy(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    notify('done', say('ports.copied'));
  } catch {
    notify('refused', say('ports.copy.refused'));
  }
}

// A table of what became of the settings. Empty: nothing is shown.
function Values({ title, rows }: { title: string; rows: readonly (readonly [string, string])[] }) {
  if (rows.length === 0) return null;
  return (
    <details>
      <summary>
        {title} ({rows.length})
      </summary>
      <table class="facts made-values" lang="en">
        <tbody>
          {rows.map(([name, words]) => (
            <tr key={name}>
              <th scope="row">
                <code>{name}</code>
              </th>
              <td>{words}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}

function Saved() {
  const kept = keptMachine.value;
  if (kept === null) return null;
  return (
    <div class="kept-machine" role="status">
      <p>
        <Icon name="calm" /> {say('ports.kept', { path: kept.path })}
      </p>
      <p>{say('ports.start')}</p>
      <pre class="toml" lang="en" tabIndex={0}>
        {kept.command}
      </pre>
      <Button icon="files" onClick={() => copy(kept.command)}>
        {say('ports.copy')}
      </Button>
    </div>
  );
}

function MadeMachine({ made, board }: { made: Made; board: string }) {
  useEffect(() => {
    fileName.value = fileNameFor(`${made.controller} ${/\/usb-(.*?)(-if\d+.*)?(@\d+)?$/.exec(board)?.[1] ?? 'machine'}`);
  }, [board]);
  return (
    <>
      <p>{say('ports.made', { controller: made.controller, board })}</p>
      {made.warnings.length > 0 && (
        <div class="refusal">
          <Icon name="warn" />
          <ul lang="en">
            {made.warnings.map((words) => (
              <li key={words}>{words}</li>
            ))}
          </ul>
        </div>
      )}
      <Values title={say('ports.assumed')} rows={made.assumed.map((one) => [one.target, one.reason])} />
      <Values title={say('ports.understood')} rows={made.understood.map((one) => [`${one.source} = ${one.value}`, one.target])} />
      <Values title={say('ports.unmapped')} rows={made.unmapped.map((one) => [`${one.source} = ${one.value}`, one.reason])} />
      <details open={keptMachine.value === null}>
        <summary>{say('ports.file')}</summary>
        <pre class="toml" lang="en" tabIndex={0}>
          {made.machine_file}
        </pre>
      </details>
      <div class="row">
        <label class="form-field">
          <span class="dim">{say('ports.file.name')}</span>
          <Typed value={fileName.value} take={(typed) => (fileName.value = typed.trim())} aria-label={say('ports.file.name')} />
        </label>
        <Button kind="accent" icon="done" why={whyNot('Idle', 'Alarm', 'Sleep')} onClick={() => keepMachine(fileName.value, made.machine_file)}>
          {say('ports.keep')}
        </Button>
        <Button icon="files" onClick={() => download(made.machine_file)}>
          {say('file.out')}
        </Button>
      </div>
      <Saved />
    </>
  );
}

export function NewMachine() {
  const now = opened.value;
  if (now === null || now.state === 'none') return null;
  return (
    <section class="panel new-machine" aria-label={say('ports.machine')}>
      <h2 class="title">{say('ports.machine')}</h2>
      {now.state === 'running' && <p role="status">{say('ports.reads', { device: now.device })}</p>}
      {now.state === 'failed' && (
        <>
          <p role="alert">{say('ports.failed', { device: now.device })}</p>
          <pre class="toml failed" lang="en" tabIndex={0}>
            {now.words}
          </pre>
        </>
      )}
      {now.state === 'done' && now.report !== null && <MadeMachine made={now.report} board={now.board} />}
    </section>
  );
}
