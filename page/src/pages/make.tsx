// Make: drawings and pictures become programs. The picture follows the form.
import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { say } from '../core/language';
import { kept } from '../core/kept';
import { goTo } from '../core/route';
import { isLive } from '../machine/connection';
import { clearDrawings, make, madeCount, order, refreshMake, sendDrawing } from '../machine/maker';
import { token } from '../machine/token';
import { Button } from '../parts/button';
import { Icon } from '../parts/icon';
import { Choice } from '../parts/view_dialog';
import { forms, type Field, type Form } from './make_forms';

type Values = Record<string, string | boolean>;
const isTable = (value: unknown): value is Record<string, Values> => typeof value === 'object' && value !== null;
// What was filled in, by job.
const filled = kept<Record<string, Values>>('make', {}, isTable);
const job = signal(forms[0]?.job ?? '');
const picked = signal<readonly string[]>([]);
const over = signal(false);

const valuesOf = (form: Form): Values => filled.value[form.job] ?? {};

function ask(form: Form): void {
  if (picked.value.length === 0) return;
  const options = Object.fromEntries(Object.entries(valuesOf(form)).filter(([, value]) => value !== '' && value !== false));
  const edge = options.edge;
  order({ job: form.job, files: picked.value.filter((one) => one !== edge), options });
}

function set(form: Form, option: string, value: string | boolean): void {
  filled.value = { ...filled.value, [form.job]: { ...valuesOf(form), [option]: value } };
  ask(form);
}

async function take(form: Form, files: Iterable<File>): Promise<void> {
  for (const file of files) await sendDrawing(file);
  const known = make.value?.files ?? [];
  if (picked.value.length === 0) picked.value = known.slice(-1);
  ask(form);
}

function Drawings({ form }: { form: Form }) {
  const input = useRef<HTMLInputElement>(null);
  const files = make.value?.files ?? [];
  const why = isLive.value ? '' : say('why.lost');
  return (
    <section class="panel" aria-label={say('make.files')}>
      <h2>{say('make.files')}</h2>
      <div
        class={`drop ${over.value ? 'over' : ''}`}
        onDragOver={(event) => {
          event.preventDefault();
          over.value = true;
        }}
        onDragLeave={() => (over.value = false)}
        onDrop={(event) => {
          event.preventDefault();
          over.value = false;
          void take(form, [...(event.dataTransfer?.files ?? [])]);
        }}
      >
        <Icon name="upload" />
        <span>{say('make.drop')}</span>
        <Button kind="accent" why={why} onClick={() => input.current?.click()}>
          {say('files.choose')}
        </Button>
        <input
          ref={input}
          type="file"
          hidden
          multiple
          accept={form.files}
          aria-label={say('files.choose')}
          onChange={(event) => {
            const field = event.currentTarget;
            void take(form, [...(field.files ?? [])]).then(() => (field.value = ''));
          }}
        />
      </div>
      <ul class="make-files">
        {files.map((name) => (
          <li key={name}>
            <label>
              <input
                type="checkbox"
                checked={picked.value.includes(name)}
                onChange={(event) => {
                  picked.value = event.currentTarget.checked ? [...picked.value, name] : picked.value.filter((one) => one !== name);
                  ask(form);
                }}
              />{' '}
              {name}
            </label>
          </li>
        ))}
      </ul>
      {files.length > 0 && (
        <Button
          icon="trash"
          why={why}
          onClick={() => {
            picked.value = [];
            return clearDrawings();
          }}
        >
          {say('make.forget')}
        </Button>
      )}
    </section>
  );
}

function OneField({ form, field }: { form: Form; field: Field }) {
  const value = valuesOf(form)[field.option];
  if (field.kind === 'flag') {
    return (
      <label class="make-flag">
        <input type="checkbox" checked={value === true} onChange={(event) => set(form, field.option, event.currentTarget.checked)} />
        <span>{say(field.title)}</span>
      </label>
    );
  }
  const words = typeof value === 'string' ? value : '';
  if (field.kind === 'text') {
    return (
      <label class="make-field">
        <span class="dim">{say(field.title)}</span>
        <input type="text" value={words} placeholder={field.usual ?? ''} onInput={(event) => set(form, field.option, event.currentTarget.value.trim())} />
      </label>
    );
  }
  const choices = field.kind === 'file' ? (make.value?.files ?? []).map((name) => [name, name] as const) : (field.choices ?? []).map(([one, title]) => [one, say(title)] as const);
  return (
    <label class="make-field">
      <span class="dim">{say(field.title)}</span>
      <select value={words} onChange={(event) => set(form, field.option, event.currentTarget.value)}>
        <option value="">{say('make.usual')}</option>
        {choices.map(([one, title]) => (
          <option key={one} value={one}>
            {title}
          </option>
        ))}
      </select>
    </label>
  );
}

function Result() {
  const now = make.value;
  const shown = now !== null && now.state === 'done' && now.picture !== '';
  const secret = token.value === '' ? '' : `&token=${token.value}`;
  return (
    <section class="panel make-result" aria-label={say('make.result')}>
      <div class="position-head">
        <h2>{say('make.result')}</h2>
        <span role="status" data-testid="make-state">
          {say(`make.state.${now?.state ?? 'none'}`)}
        </span>
      </div>
      {shown && <img src={`api/v1/make/picture?order=${madeCount.value}${secret}`} alt={say('make.picture')} />}
      {now !== null && now.words !== '' && (
        <pre class={`toml ${now.state === 'failed' ? 'failed' : ''}`} lang="en" tabIndex={0}>
          {now.words}
        </pre>
      )}
      <div class="row">
        <Button kind="accent" icon="run" why={now?.program == null ? say('make.none') : ''} onClick={() => goTo('files')}>
          {say('make.open')}
        </Button>
      </div>
    </section>
  );
}

export function MakePage() {
  useEffect(() => {
    if (isLive.value) void refreshMake();
  }, [isLive.value]);
  const form = forms.find((one) => one.job === job.value) ?? forms[0];
  if (form === undefined) return null;
  return (
    <div class="make">
      <div class="pins-side">
        <section class="panel" aria-label={say('make.job')}>
          <Choice
            title={say('make.job')}
            value={form.job}
            all={forms.map((one) => [one.job, say(one.title)] as const)}
            set={(to) => {
              job.value = to;
              const next = forms.find((one) => one.job === to);
              if (next !== undefined) ask(next);
            }}
          />
        </section>
        <Drawings form={form} />
        <section class="panel" aria-label={say(form.title)}>
          <h2>{say(form.title)}</h2>
          <div class="make-fields">
            {form.fields.map((field) => (
              <OneField key={`${form.job} ${field.option}`} form={form} field={field} />
            ))}
          </div>
          <p class="dim">{say('make.lengths')}</p>
        </section>
      </div>
      <Result />
    </div>
  );
}
