// CAM: drawings and pictures become programs. The picture follows the form.
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { goTo } from '../core/route';
import { lengthUnit } from '../core/units';
import { isLive } from '../machine/connection';
import { needFile } from '../machine/machine_file';
import { clearDrawings, cam, madeCount, removeDrawing } from '../machine/cam';
import { forgetShapes, jobFile } from '../machine/job_file';
import { token } from '../machine/token';
import { Button } from '../parts/button';
import { DropZone } from '../parts/drop_zone';
import { ProgressBar } from '../parts/progress_bar';
import { SelectField } from '../parts/select';
import { Choice } from '../parts/view_dialog';
import { forms, taken, usualOf, withUnit, type Field, type Form } from './cam_forms';
import { BoardLayers, BoardSteps } from './cam_board';
import { JobPanels } from './cam_job';
import { JobPicture } from './cam_job_picture';
import { ask, fieldsOf, formNow, job, jobForm, layers, lookAtCam, partsOf, pick, picked, set, takeDrawings, valuesOf } from './cam_order';

async function removeOne(name: string): Promise<void> {
  if (!(await removeDrawing(name))) return;
  picked.value = picked.value.filter((one) => one !== name);
  if (jobFile.value?.name === name) jobFile.value = null;
  forgetShapes(name);
  ask(formNow());
}

function Drawings({ form }: { form: Form }) {
  const files = cam.value?.files ?? [];
  const why = isLive.value ? '' : say('why.lost');
  const isJob = form.job === jobForm;
  return (
    <section class="panel" aria-label={say('cam.files')}>
      <h2>{say('cam.files')}</h2>
      <DropZone choose={say('files.choose')} why={why} {...(isJob ? {} : { accept: form.files })} take={takeDrawings}>
        {say('cam.drop')}
      </DropZone>
      {form.job === 'wire' && <p class="dim">{say('cam.wire.sides')}</p>}
      <ul class="cam-files">
        {files.map((name) => (
          <li key={name}>
            {isJob ? (
              <span>{name}</span>
            ) : (
              <label>
                <input type="checkbox" checked={taken(form, picked.value).includes(name)} onChange={(event) => pick(name, event.currentTarget.checked)} />{' '}
                {name}
              </label>
            )}
            <Button icon="trash" label={say('cam.remove', { name })} why={why} onClick={() => removeOne(name)} />
          </li>
        ))}
      </ul>
      {files.length > 0 && (
        <Button
          icon="trash"
          why={why}
          onClick={() => {
            picked.value = [];
            layers.value = {};
            jobFile.value = null;
            forgetShapes();
            return clearDrawings();
          }}
        >
          {say('cam.forget')}
        </Button>
      )}
    </section>
  );
}

function OneField({ form, field }: { form: Form; field: Field }) {
  const value = valuesOf(form)[field.option];
  if (field.kind === 'flag') {
    return (
      <label class="cam-flag">
        <input type="checkbox" checked={value === true} onChange={(event) => set(form, field.option, event.currentTarget.checked)} />
        <span>{say(field.title)}</span>
      </label>
    );
  }
  const words = typeof value === 'string' ? value : '';
  if (field.kind === 'text') {
    return (
      <label class="form-field">
        <span class="dim">{say(field.title)}</span>
        <input type="text" value={words} placeholder={usualOf(field)} onInput={(event) => set(form, field.option, event.currentTarget.value)} onChange={(event) => set(form, field.option, withUnit(field, event.currentTarget.value.trim()))} />
      </label>
    );
  }
  const files = field.kind === 'choice' ? [] : (cam.value?.files ?? []).map((name) => [name, name] as const);
  const choices = [...field.choices.map(([one, title]) => [one, say(title)] as const), ...files];
  if (field.kind === 'name') {
    const list = `cam-${form.job}-${field.option}`;
    return (
      <label class="form-field">
        <span class="dim">{say(field.title)}</span>
        <input type="text" list={list} value={words} placeholder={field.without !== null ? say(field.without) : ''} onChange={(event) => set(form, field.option, event.currentTarget.value.trim())} />
        <datalist id={list}>
          {choices.map(([one, title]) => (
            <option key={one} value={one}>
              {title}
            </option>
          ))}
        </datalist>
      </label>
    );
  }
  return <SelectField title={say(field.title)} value={words} all={choices} none={field.without !== null ? say(field.without) : ''} set={(to) => set(form, field.option, to)} />;
}

function Fields({ form, fields }: { form: Form; fields: readonly Field[] }) {
  return (
    <div class="form-fields">
      {fields.map((field) => (
        <OneField key={`${form.job} ${field.option}`} form={form} field={field} />
      ))}
    </div>
  );
}

function Result() {
  const now = cam.value;
  const shown = now !== null && now.state === 'done' && now.picture !== '';
  const secret = token.value === '' ? '' : `&token=${token.value}`;
  return (
    <section class="panel cam-result" aria-label={say('cam.result')}>
      <div class="position-head">
        <h2>{say('cam.result')}</h2>
        <span role="status" data-testid="cam-state">
          {say(`cam.state.${now?.state ?? 'none'}`)}
        </span>
      </div>
      {now?.state === 'running' && <ProgressBar share={now.progress} name={say('cam.state.running')} />}
      {shown && now.job !== 'board' && <img src={`api/v1/cam/picture?order=${madeCount.value}${secret}`} alt={say('cam.picture')} />}
      {now !== null && now.words !== '' && (
        <pre class={`toml ${now.state === 'failed' ? 'failed' : ''}`} lang="en" tabIndex={0}>
          {now.words}
        </pre>
      )}
      <BoardSteps />
      {now?.job !== 'board' && now?.page === true && (
        <a href={`api/v1/cam/page?made=${madeCount.value}${secret}`} target="_blank" rel="noopener">
          {say('cam.board.page')}
        </a>
      )}
      {now?.job !== 'board' && <div class="row">
        <Button kind="accent" icon="run" why={now?.program == null ? say('cam.none') : ''} onClick={() => goTo('files')}>
          {say('cam.open')}
        </Button>
      </div>}
    </section>
  );
}

export function CamPage() {
  useEffect(() => {
    if (!isLive.value) return;
    void lookAtCam();
    void needFile();
  }, [isLive.value]);
  const form = formNow();
  // A job is made again after each edit without errors.
  const stamp = jobFile.value?.good === true ? `${jobFile.value.name} ${jobFile.value.stamp}` : '';
  useEffect(() => {
    if (stamp !== '' && formNow()?.job === jobForm) ask(formNow());
  }, [stamp]);
  if (form === undefined) return null;
  return (
    <div class="cam">
      <div class="pins-side">
        <section class="panel" aria-label={say('cam.operation')}>
          <Choice
            title={say('cam.operation')}
            value={form.job}
            all={forms.value.map((one) => [one.job, say(one.title)] as const)}
            set={(to) => {
              job.value = to;
              ask(formNow());
            }}
          />
        </section>
        <Drawings form={form} />
        {form.job === jobForm && <JobPanels />}
        {form.fields.length + form.more.length > 0 && <section class="panel" aria-label={say(form.title)}>
          <h2>{say(form.title)}</h2>
          <Fields form={form} fields={form.fields} />
          {form.more.length > 0 && (
            <details>
              <summary>{say('cam.more')}</summary>
              <Fields form={form} fields={form.more} />
            </details>
          )}
          {partsOf(form).map((part) => (
            <details key={part.job}>
              <summary>
                {say(part.title)}: {say('cam.board.options')}
              </summary>
              <Fields form={part} fields={fieldsOf(part).filter((field) => !field.ofJob)} />
            </details>
          ))}
          <p class="dim">{say('cam.lengths', { unit: lengthUnit() })}</p>
        </section>}
        {form.job === 'board' && <BoardLayers />}
      </div>
      <div class="pins-side">
        {form.job === jobForm && <JobPicture />}
        <Result />
      </div>
    </div>
  );
}
