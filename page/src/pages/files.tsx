// Files and jobs: programs with what their check has found, the queue, the history.
import { useEffect } from 'preact/hooks';
import { language, say, sayCount } from '../core/language';
import { attempt } from '../core/notices';
import { confirm } from '../core/question';
import { reportWords } from '../core/faults';
import { goTo } from '../core/route';
import { clockText, durationText, momentText } from '../core/time';
import { lengthText, lengthUnit } from '../core/units';
import { whyNoJob, whyNot } from '../machine/actions';
import type { HistoryJob, Program } from '../machine/api';
import { ask, post, remove, upload } from '../machine/api';
import { stillAddress } from '../machine/camera';
import { isLive, machine, status } from '../machine/connection';
import { alarms, ended, keeps, queue, refreshHistory } from '../machine/history';
import { needOperations } from '../machine/cam';
import { frameJob, whyNoFrame } from '../machine/framing';
import { beOwner } from '../machine/owner';
import { pathBox, pathIndex } from '../machine/path_index';
import { checkProgram, chosen, deleteProgram, isListed, leaveOut, programs, sending, sendProgram, shown, shownId, timeOf } from '../machine/programs';
import { loadsOfShown } from '../machine/studies';
import { lookOf, overallVerdict, type OverallLook } from '../machine/verdict';
import { wordsOfWait } from '../machine/waits';
import { isUnderWay } from '../machine/words';
import { BoardFiles } from '../parts/board_files';
import { Button } from '../parts/button';
import { DropZone } from '../parts/drop_zone';
import { Icon, type IconName } from '../parts/icon';
import { MotorLoad } from '../parts/motor_load';
import { Proposals } from '../parts/proposals';
import { picked } from '../scene/stage';
import { isDrawing } from './cam_forms';
import { takeDrawings } from './cam_order';

const mostFindings = 100;
const linesShown = 3; // of the other lines with the same warning

async function take(files: readonly File[]): Promise<void> {
  await needOperations();
  const drawings = files.filter((file) => isDrawing(file.name));
  for (const file of files) if (!isDrawing(file.name)) await attempt(() => sendProgram(file));
  if (drawings.length === 0) return;
  goTo('cam');
  await takeDrawings(drawings);
}

const icons: Record<OverallLook, IconName> = { good: 'calm', warned: 'warn', bad: 'bad', pending: 'reset' };
const overallOf = (program: Program) => overallVerdict(program, program.id === shownId.value ? loadsOfShown.value : null);

function ProgramRow({ program }: { program: Program }) {
  const isShown = program.id === shownId.value;
  const verdict = overallOf(program);
  const look = lookOf(verdict);
  return (
    <li>
      <button type="button" class="file-row" aria-pressed={isShown} onClick={() => (chosen.value = program.id)}>
        <span class={`verdict ${look}`}>
          <Icon name={icons[look]} />
        </span>
        <span class="file-name">{program.name}</span>
        <span class="dim">{say(`files.state.${verdict}`)}</span>
        <span class="dim">{program.state === 'good' ? durationText(timeOf(program)) : ''}</span>
      </button>
    </li>
  );
}

function ShownProgram() {
  const program = shown.value;
  if (program === null) return null;
  const verdict = overallOf(program);
  const look = lookOf(verdict);
  const work = pathIndex.value?.program === program.id ? pathBox.value : null;
  const runs = isUnderWay(status.value?.job ?? null) && status.value?.job?.program === program.id;
  const whyDelete = runs ? say('why.state', { state: say(`state.${status.value?.state ?? 'Run'}`) }) : isLive.value ? '' : say('why.lost');
  return (
    <section class="panel" aria-label={program.name}>
      <h2 class="title">{program.name}</h2>
      <p class={`verdict big ${look}`} data-testid="verdict">
        <Icon name={icons[look]} /> {say(`files.state.${verdict}`)}
      </p>
      <dl class="figures">
        <div>
          <dt>{say('run.whole')}</dt>
          <dd class="figure">{durationText(timeOf(program))}</dd>
        </div>
        <div>
          <dt>{say('run.program')}</dt>
          <dd>
            {sayCount('files.lines', program.lines)},{' '}
            {sayCount('files.moves', program.moves)}
          </dd>
        </div>
        {work !== null && (
          <div>
            <dt>{say('files.extents')}</dt>
            <dd>
              {(['X', 'Y', 'Z'] as const).map((axis, i) => (
                <div key={axis}>
                  {axis} {lengthText(work.low[i] ?? 0, 2)} … {lengthText(work.high[i] ?? 0, 2)} {lengthUnit()}
                </div>
              ))}
            </dd>
          </div>
        )}
      </dl>
      <div class="row">
        <Button kind="accent" icon="run" onClick={() => goTo('run')}>
          {say('files.show')}
        </Button>
        <Button icon="frame" why={whyNoFrame(program)} onClick={() => frameJob(program)}>
          {say('framing.do')} …
        </Button>
        <Button why={whyNot('Idle')} icon="reset" onClick={() => attempt(() => checkProgram(program.id))}>
          {say('files.check')}
        </Button>
        {keeps.value === true && (
          <Button icon="plus" why={isLive.value ? '' : say('why.lost')} onClick={() => attempt(() => enqueue(program))}>
            {say('files.queue')}
          </Button>
        )}
        {program.deleted_lines > 0 && (
          <Button pressed={program.block_delete} why={whyDelete} onClick={() => attempt(() => leaveOut(program, !program.block_delete))}>
            {say('files.leave.out', { lines: program.deleted_lines.toLocaleString(language.value) })}
          </Button>
        )}
        <Button icon="trash" why={whyDelete} onClick={() => deleteAsked(program)}>
          {say('files.delete')}
        </Button>
      </div>
      <MotorLoad program={program} />
      <Findings program={program} />
      <Proposals program={program} />
    </section>
  );
}

function Findings({ program }: { program: Program }) {
  const all = program.findings ?? [];
  if (program.state !== 'good' && program.state !== 'bad') return null;
  return (
    <>
      <h2 class="findings-title">{say('files.findings')}</h2>
      {all.length === 0 && <p class="dim">{say('files.findings.none')}</p>}
      <ul class="findings">
        {all.slice(0, mostFindings).map((one) => (
          <li key={`${one.line} ${one.code} ${one.column}`} class={one.severity}>
            <button
              type="button"
              class="finding"
              onClick={() => {
                picked.value = one.line;
                goTo('run');
              }}
            >
              <Icon name={one.severity === 'error' ? 'bad' : 'warn'} />
              <span>
                <b>{say('run.line', { line: one.line })}</b> {reportWords(one.message, one.message_sentence)}.{' '}
                {one.expected !== '' && <span class="dim">{say('files.expected', { expected: reportWords(one.expected, one.expected_sentence) })}</span>}{' '}
                {one.more_lines.length > 0 && (
                  <span class="dim">
                    {sayCount('files.more.lines', one.more_lines.length, {
                      lines: one.more_lines.slice(0, linesShown).join(', ') + (one.more_lines.length > linesShown ? ', …' : ''),
                    })}
                  </span>
                )}{' '}
                <code class="dim">{one.code}</code>
              </span>
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}

async function deleteAsked(program: Program): Promise<void> {
  const yes = await confirm({
    title: say('files.delete.ask', { name: program.name }),
    facts: [say('files.delete.facts')],
    yes: say('files.delete'),
    kind: 'stop',
  });
  if (!yes) return;
  await attempt(async () => {
    await beOwner();
    await deleteProgram(program.id);
  });
}

async function enqueue(program: Program): Promise<void> {
  const lines = 2000;
  const parts: string[] = [];
  for (let from = 1; from <= program.lines; from += lines) {
    parts.push(await (await ask('GET', `/programs/${program.id}/text?from=${from}&lines=${lines}`)).text());
  }
  await upload('/queue', program.name, new Blob(parts), `&dialect=${program.dialect}&block_delete=${program.block_delete}`);
  await refreshHistory();
}

async function runQueued(job: HistoryJob): Promise<void> {
  await attempt(async () => {
    await beOwner();
    await post(`/queue/${job.id}/run`);
    goTo('run');
  });
}

function JobList({ jobs, none, queued }: { jobs: readonly HistoryJob[]; none: string; queued: boolean }) {
  if (jobs.length === 0) return <p class="dim">{none}</p>;
  return (
    <ul class="jobs">
      {jobs.map((job) => (
        <li key={job.id}>
          <Icon name={job.state === 'done' ? 'calm' : job.state === 'failed' || job.state === 'interrupted' ? 'bad' : 'hold'} />
          <span class="file-name">{job.name}</span>
          <span class="dim">
            {say(`files.job.${job.state}`)}
            {job.why === '' ? '' : `: ${reportWords(job.why, job.why_sentence)}`}
          </span>
          <span class="dim">{momentText(queued ? job.queued_at : job.ended_at, language.value)}</span>
          {(job.waits ?? []).map((one, i) => (
            <span class="dim job-wait" key={i}>
              {clockText(new Date(one.at * 1000), language.value)} {wordsOfWait(one)}
              {one.message === '' ? '' : `: ${one.message.replaceAll('\n', ' · ')}`}
            </span>
          ))}
          {(job.stills ?? []).length > 0 && (
            <span class="job-stills">
              {(job.stills ?? []).map((one) => (
                <a key={one.id} href={stillAddress(one.id)} target="_blank" rel="noreferrer">
                  <img src={stillAddress(one.id)} loading="lazy" alt={say(`files.still.${one.moment}`, { name: job.name })} />
                </a>
              ))}
            </span>
          )}
          {queued && (
            <span class="row">
              <Button icon="run" why={whyNoJob.value} onClick={() => runQueued(job)}>
                {say('files.run')}
              </Button>
              <Button
                icon="trash"
                label={`${say('files.delete')}: ${job.name}`}
                why={isLive.value ? '' : say('why.lost')}
                onClick={() =>
                  attempt(async () => {
                    await beOwner();
                    await remove(`/queue/${job.id}`);
                    await refreshHistory();
                  })
                }
              />
            </span>
          )}
        </li>
      ))}
    </ul>
  );
}

const stillsAfter = 2000; // ms

export function FilesPage() {
  const job = status.value?.job;
  const hasCamera = Boolean(machine.value?.camera);
  useEffect(() => {
    void refreshHistory();
    // The picture of its end comes a little later.
    const later = hasCamera ? setTimeout(() => void refreshHistory(), stillsAfter) : undefined;
    return () => clearTimeout(later);
  }, [job?.id, job?.state, isLive.value, hasCamera]);
  const all = programs.value.filter(isListed).reverse();
  return (
    <div class="files">
      <div class="files-side">
        <DropZone choose={say('files.choose')} why={isLive.value ? '' : say('why.lost')} take={take}>
          {sending.value === null ? say('files.drop') : say('files.uploading', { name: sending.value })}
        </DropZone>
        <section class="panel" aria-label={say('files.programs')}>
          <h2>{say('files.programs')}</h2>
          {all.length === 0 && <p class="dim">{say('files.none')}</p>}
          <ul class="file-list">
            {all.map((program) => (
              <ProgramRow key={program.id} program={program} />
            ))}
          </ul>
        </section>
        <BoardFiles />
        {keeps.value === false && <p class="dim past">{say('files.history.off')}</p>}
        {keeps.value === true && (
          <>
            <section class="panel past" aria-label={say('files.queued')}>
              <h2>{say('files.queued')}</h2>
              <JobList jobs={queue.value} none={say('files.queued.none')} queued={true} />
            </section>
            <section class="panel past" aria-label={say('files.history')}>
              <h2>{say('files.history')}</h2>
              <JobList jobs={ended.value} none={say('files.history.none')} queued={false} />
            </section>
            <section class="panel past" aria-label={say('files.alarms')}>
              <h2>{say('files.alarms')}</h2>
              {alarms.value.length === 0 && <p class="dim">{say('files.alarms.none')}</p>}
              <ul class="jobs">
                {alarms.value.map((one) => (
                  <li key={one.at}>
                    <Icon name="bad" />
                    <span>{reportWords(one.words, one.sentence)}</span>
                    <span class="dim">{momentText(one.at, language.value)}</span>
                  </li>
                ))}
              </ul>
            </section>
          </>
        )}
      </div>
      <ShownProgram />
    </div>
  );
}

