// "Check my program": the visitor gives a program and a machine, and this browser shows the results of `passo check`.
import '../style/pages.css';
import './check.css';
import { useEffect } from 'preact/hooks';
import { durationText } from '../core/time';
import { language } from '../core/language';
import { Button } from '../parts/button';
import { DropZone } from '../parts/drop_zone';
import { Icon } from '../parts/icon';
import { ProgressBar } from '../parts/progress_bar';
import { SceneView } from '../scene/scene_view';
import { exampleMachine, examples, type ChosenMachine } from './examples';
import { motorKinds } from './motors';
import { ProgramLines } from './ProgramLines';
import { Axes, Badges, Findings, Motors, Remedies, Speed, Times } from './Results';
import { cancel, check, chosenMachine, dialect, inches, load, loadModule, motor, program, refusal, result, running, take, text } from './state';
import { say } from './words';

export function CheckPage() {
  useEffect(() => void loadModule().catch(() => undefined), []);
  const answer = result.value?.answer;
  return (
    <div class="check">
      <header class="check-head">
        <h1>{say('title')}</h1>
        <p>{say('lesson')}</p>
      </header>
      <div class="check-setup">
        <Drop />
        <Choices />
      </div>
      <div role="status" class="check-status">
        <Progress />
        <Refused />
        {answer !== undefined && <Badges answer={answer} />}
      </div>
      {answer !== undefined && !answer.machine.good && <Findings findings={answer.machine.findings} title={chosenMachine.value.file} own={false} />}
      {answer?.machine.good && (
        <div class="check-results">
          <div class="check-column">
            <Findings findings={answer.findings ?? []} title={say('findings')} own />
            <Remedies answer={answer} />
            <Times answer={answer} />
            <Motors answer={answer} />
            <Speed answer={answer} />
            <Axes answer={answer} />
            <p class="dim">{say('notIncluded')}</p>
            <p class="dim" data-testid="took">
              {say('took', {
                seconds: (result.value?.seconds ?? 0).toLocaleString(language.value, { maximumFractionDigits: 1 }),
                megabytes: Math.round(result.value?.megabytes ?? 0),
              })}
            </p>
          </div>
          <div class="check-column check-views">
            {(answer.path?.points ?? 0) > 0 && (
              <section class="panel check-scene" aria-label={say('path')}>
                <SceneView alone />
              </section>
            )}
            {answer.path?.cut_off === true && <p class="dim">{say('cutOff')}</p>}
            {text.value !== null && <ProgramLines text={text.value} findings={answer.findings ?? []} />}
          </div>
        </div>
      )}
    </div>
  );
}

function Drop() {
  return (
    <DropZone choose={say('choose')} classes="check-drop" take={take}>
      <b class="check-file">{program.value?.name ?? say('drop')}</b>
      <small>{say('dropMore')}</small>
    </DropZone>
  );
}

function Choices() {
  const machine = chosenMachine.value;
  const again = (): void => void check();
  return (
    <div class="check-choices">
      <label>
        <span>{say('machine')}</span>
        <select
          value={machine.own ? '' : machine.file}
          onChange={(event) => {
            chosenMachine.value = exampleMachine(event.currentTarget.value);
            again();
          }}
        >
          {machine.own && (
            <optgroup label={say('ownMachine')}>
              <option value="">{machine.file}</option>
            </optgroup>
          )}
          <optgroup label={say('exampleMachines')}>
            {examples.map((one) => (
              <option key={one.file} value={one.file}>
                {one.name} ({one.file})
              </option>
            ))}
          </optgroup>
        </select>
      </label>
      <label title={say('motorNote')}>
        <span>{say('motor')}</span>
        <select
          value={motor.value}
          onChange={(event) => {
            motor.value = event.currentTarget.value;
            again();
          }}
        >
          <option value="">{say('motorOfFile')}</option>
          {Object.entries(motorKinds).map(([key, one]) => (
            <option key={key} value={key}>
              {one.name}
            </option>
          ))}
        </select>
      </label>
      {motor.value !== '' && (
        <>
          <NumberField label={say('mass')} unit="kg" value={load.value.mass} most={1000} set={(mass) => (load.value = { ...load.value, mass })} />
          <NumberField label={say('friction')} unit="N" value={load.value.friction} most={10_000} set={(friction) => (load.value = { ...load.value, friction })} />
        </>
      )}
      <label>
        <span>{say('dialect')}</span>
        <select
          value={dialect.value}
          onChange={(event) => {
            dialect.value = event.currentTarget.value as typeof dialect.value;
            again();
          }}
        >
          <option value="linuxcnc">LinuxCNC</option>
          <option value="grbl">Grbl 1.1</option>
        </select>
      </label>
      <label class="check-tick">
        <input
          type="checkbox"
          checked={inches.value}
          onChange={(event) => {
            inches.value = event.currentTarget.checked;
            again();
          }}
        />
        <span>{say('inches')}</span>
      </label>
      {program.value !== null && running.value === null && (
        <Button icon="run" onClick={again}>
          {say('check')}
        </Button>
      )}
      <ImportNotes machine={machine} />
    </div>
  );
}

// Lists what a file of another controller does not contain, and what the page assumed instead.
function ImportNotes({ machine }: { machine: ChosenMachine }) {
  const made = machine.imported;
  if (made === undefined) return null;
  const lists = [
    ['importWarnings', made.warnings],
    ['importAssumed', made.assumed],
    ['importUnmapped', made.unmapped],
  ] as const;
  return (
    <div class="check-notes">
      <p>{say('imported', { controller: made.controller, count: made.understood })}</p>
      {lists.map(
        ([title, all]) =>
          all.length > 0 && (
            <details key={title} open={title === 'importWarnings'}>
              <summary>
                {say(title)}: {all.length}
              </summary>
              <ul>
                {all.map((one, i) => (
                  <li key={i}>{one}</li>
                ))}
              </ul>
            </details>
          ),
      )}
      <a class="button" download={`${machine.file.replace(/\.[^.]*$/, '')}.toml`} href={downloadOf(machine.text)}>
        {say('importDownload')}
      </a>
    </div>
  );
}
let download = { text: '', address: '' };
function downloadOf(text: string): string {
  if (download.text === text) return download.address;
  if (download.address !== '') URL.revokeObjectURL(download.address);
  download = { text, address: URL.createObjectURL(new Blob([text], { type: 'application/toml' })) };
  return download.address;
}

interface NumberProps {
  label: string;
  unit: string;
  value: number;
  most: number;
  set: (value: number) => void;
}
function NumberField({ label, unit, value, most, set }: NumberProps) {
  return (
    <label>
      <span>
        {label}, {unit}
      </span>
      <input
        type="number"
        min={0}
        max={most}
        step="any"
        value={value}
        onChange={(event) => {
          const number = event.currentTarget.valueAsNumber;
          if (!(number >= 0 && number <= most)) return;
          set(number);
          void check();
        }}
      />
    </label>
  );
}

function Progress() {
  const now = running.value;
  if (now === null) return null;
  return (
    <div class="panel check-progress">
      <p>
        {say(now.stage)} … {now.stage !== 'proposals' && `${Math.floor(100 * now.share)} %`}
        {now.left !== null && `, ${say('left', { time: durationText(now.left) })}`}
      </p>
      <ProgressBar share={now.share} name={say(now.stage)} />
      <Button icon="close" kind="stop" onClick={cancel}>
        {say('cancel')}
      </Button>
    </div>
  );
}

function Refused() {
  const why = refusal.value;
  if (why === null) return null;
  const size = Math.round((program.value?.size ?? 0) / 1e6);
  const words = {
    'too-large': () => say('tooLarge', { size }),
    memory: () => say('memory'),
    empty: () => say('empty'),
    failed: () => say('failed', { words: why.words }),
    'no-module': () => say('noModule'),
    cancelled: () => say('cancelled'),
    'other-file': () => say('otherFile', { file: why.words }),
  }[why.kind]();
  return (
    <p class="check-refused" data-testid="refused">
      <Icon name="warn" /> {words}
    </p>
  );
}
