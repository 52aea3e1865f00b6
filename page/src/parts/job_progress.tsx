// The program, how far it is, and when it ends.
import { computed } from '@preact/signals';
import { language, say, sayCount } from '../core/language';
import { clockText, durationText } from '../core/time';
import { goTo } from '../core/route';
import { status } from '../machine/connection';
import { frameJob, whyNoFrame } from '../machine/framing';
import { shown, timeOf } from '../machine/programs';
import { loadsOfShown } from '../machine/studies';
import { lookOf, overallVerdict } from '../machine/verdict';
import { isUnderWay } from '../machine/words';
import { BoardFileProgress } from './board_files';
import { Button } from './button';
import { ProgressBar } from './progress_bar';

// The job of the shown program, if it runs.
const run = computed(() => {
  const now = status.value;
  const program = shown.value;
  if (now === null || program === null || now.job === null || !isUnderWay(now.job) || now.job.program !== program.id) return null;
  const progress = now.progress ?? 0;
  return { progress, left: now.left ?? timeOf(program) * (1 - progress), line: now.line };
});

export function JobProgress() {
  const program = shown.value;
  const boardFile = status.value?.board_file ?? null;
  if (boardFile !== null) return <BoardFileProgress path={boardFile} />;
  if (program === null) {
    return (
      <section class="panel job">
        <h2>{say('run.program')}</h2>
        <p class="row">
          {say('run.no.program')}
          <Button kind="accent" icon="files" onClick={() => goTo('files')}>
            {say('run.open')}
          </Button>
        </p>
      </section>
    );
  }
  const verdict = overallVerdict(program, loadsOfShown.value);
  const now = run.value;
  const percent = (now?.progress ?? 0) * 100;
  return (
    <section class="panel job">
      <div class="position-head">
        <h2 class="job-name">{program.name}</h2>
        <span class={`verdict ${lookOf(verdict)}`}>{say(`files.state.${verdict}`)}</span>
      </div>
      <ProgressBar share={now?.progress ?? 0} name={say('run.progress')} />
      <div class="job-figures">
        <div>
          <span class="dim">{say('run.progress')}</span>
          <b class="figure">{percent.toFixed(percent < 10 ? 1 : 0)} %</b>
        </div>
        <div>
          <span class="dim">{say(now === null ? 'run.whole' : 'run.left')}</span>
          <b class="figure" data-testid="left">
            {now === null ? durationText(timeOf(program)) : durationText(now.left)}
          </b>
        </div>
        <div>
          <span class="dim">{say('run.end')}</span>
          <b class="figure">
            {now === null ? '–' : clockText(new Date(Date.now() + now.left * 1000), language.value)}
          </b>
        </div>
      </div>
      <p class="dim job-line">
        {now === null
          ? sayCount('files.lines', program.lines)
          : say('run.of.lines', { line: now.line, lines: program.lines.toLocaleString(language.value) })}
      </p>
      {now === null && (
        <div class="row">
          <Button icon="frame" why={whyNoFrame(program)} onClick={() => frameJob(program)}>
            {say('framing.do')} …
          </Button>
        </div>
      )}
    </section>
  );
}
