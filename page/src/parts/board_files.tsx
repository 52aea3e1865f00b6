// The files on the card of the board, where it has one: listed, sent, deleted, and run by the board itself.
import { useEffect } from 'preact/hooks';
import { reportWords } from '../core/faults';
import { say } from '../core/language';
import { confirm } from '../core/question';
import { goTo } from '../core/route';
import { durationText } from '../core/time';
import { moveAs, whyNoJob, whyNot } from '../machine/actions';
import {
  cancelSending, deleteFile, hasStorage, isThere, kiloBytes, learnFiles, listFiles, pathFor, sendFile, toldFiles, worksAtFiles, type BoardFile, type BoardFilesTold,
} from '../machine/board_files';
import { isLive, status } from '../machine/connection';
import { placeWords, workPlace } from '../machine/place';
import { Button } from './button';
import { FileChoice } from './file_choice';
import { Icon } from './icon';
import { ProgressBar } from './progress_bar';

const why = (): string => (worksAtFiles.value ? say('board.files.order') : whyNot('Idle'));

// Why the board cannot run a file now. Empty: it can.
function whyNoRun(file: BoardFile): string {
  if (!file.can_run) return say('board.files.unusable');
  return worksAtFiles.value ? say('board.files.order') : whyNoJob.value;
}

async function runAsked(file: BoardFile): Promise<void> {
  const isChecked = file.program !== null;
  const yes = await confirm({
    title: say('board.files.run.ask', { path: file.path }),
    facts: [
      isChecked ? say('board.files.run.checked', { place: placeWords(workPlace.value) }) : say('board.files.run.unchecked'),
      say('board.files.run.by.itself'),
    ],
    yes: say(isChecked ? 'board.files.run' : 'board.files.run.unchecked.yes'),
    kind: isChecked ? 'go' : 'stop',
  });
  if (yes && (await moveAs('/board/run', { path: file.path, unchecked: !isChecked }))) goTo('run');
}

async function deleteAsked(path: string): Promise<void> {
  const facts = [say('board.files.delete.facts')];
  const yes = await confirm({ title: say('board.files.delete.ask', { path }), facts, yes: say('files.delete'), kind: 'stop' });
  if (yes) await deleteFile(path);
}

async function send(told: BoardFilesTold, file: File): Promise<void> {
  const path = pathFor(told.folder, file.name);
  const facts = [say('board.files.replace.facts')];
  const mayReplace =
    !isThere(told, path) || (await confirm({ title: say('board.files.replace.ask', { path }), facts, yes: say('board.files.send'), kind: 'stop' }));
  if (mayReplace) await sendFile(path, file);
}

function Row({ file }: { file: BoardFile }) {
  const isChecked = file.program !== null;
  return (
    <li data-file={file.path}>
      <Icon name={isChecked ? 'calm' : 'warn'} />
      <span class="file-name">{file.path}</span>
      <span class="dim">
        {say('board.files.size', { size: kiloBytes(file.bytes) })} · {say(isChecked ? 'board.files.checked' : 'board.files.unchecked')}
      </span>
      <span class="row">
        <Button icon="run" why={whyNoRun(file)} onClick={() => runAsked(file)}>
          {say('board.files.run')} …
        </Button>
        <Button icon="trash" label={`${say('files.delete')}: ${file.path}`} why={why()} onClick={() => deleteAsked(file.path)} />
      </span>
    </li>
  );
}

function Sending({ told }: { told: BoardFilesTold }) {
  const values = { path: told.path, percent: Math.floor(100 * told.share) };
  return (
    <div class="board-files-sending">
      <p role="status">
        {told.left === null ? say('board.files.sending', values) : say('board.files.sending.left', { ...values, time: durationText(told.left) })}
      </p>
      <ProgressBar share={told.share} name={told.path} />
      <Button icon="stop" why={isLive.value ? '' : say('why.lost')} onClick={cancelSending}>
        {say('board.files.cancel')}
      </Button>
    </div>
  );
}

function Order({ told }: { told: BoardFilesTold }) {
  if (told.state === 'failed') {
    return (
      <p class="refusal" role="alert">
        {reportWords(told.words, told.why)}
      </p>
    );
  }
  if (told.state !== 'running') return null;
  if (told.order === 'upload' && told.share < 1) return <Sending told={told} />;
  return <p role="status">{told.order === 'remove' ? say('board.files.removing', { path: told.path }) : say('board.files.listing')}</p>;
}

export function BoardFiles() {
  const isIdle = status.value?.state === 'Idle';
  useEffect(() => {
    if (isLive.value && hasStorage.value) void learnFiles();
  }, [isLive.value, hasStorage.value, isIdle]);
  const told = toldFiles.value;
  if (!hasStorage.value || told === null) return null;
  const whyNoUpload = told.why_no_upload === null ? why() : reportWords(told.words_no_upload, told.why_no_upload);
  return (
    <section class="panel past board-files" aria-label={say('board.files')}>
      <h2>{say('board.files')}</h2>
      <p class="dim">{say('board.files.what')}</p>
      <div class="row">
        <Button kind={told.files === null ? 'accent' : 'plain'} icon="reset" why={why()} onClick={listFiles}>
          {say(told.files === null ? 'board.files.list' : 'board.files.list.again')}
        </Button>
        <FileChoice label={say('board.files.send')} take={async ([file]) => file !== undefined && send(told, file)}>
          {(choose) => (
            <Button icon="upload" why={whyNoUpload} onClick={choose}>
              {say('board.files.send')}
            </Button>
          )}
        </FileChoice>
      </div>
      <Order told={told} />
      {told.files === null && told.state !== 'running' && <p class="dim">{say('board.files.unlisted')}</p>}
      {told.files?.length === 0 && <p class="dim">{say('board.files.none')}</p>}
      <ul class="jobs">
        {(told.files ?? []).map((file) => (
          <Row key={file.path} file={file} />
        ))}
      </ul>
    </section>
  );
}

// On the Run page, instead of the program: what the board does by itself.
export function BoardFileProgress({ path }: { path: string }) {
  const share = status.value?.progress ?? 0;
  return (
    <section class="panel job" aria-label={path}>
      <div class="position-head">
        <h2 class="job-name">{path}</h2>
      </div>
      <ProgressBar share={share} name={say('board.files.read')} />
      <div class="job-figures">
        <div>
          <span class="dim">{say('board.files.read')}</span>
          <b class="figure">{(100 * share).toFixed(0)} %</b>
        </div>
      </div>
      <p class="dim">{say('board.files.runs.what')}</p>
    </section>
  );
}
