// What has happened since this page was opened: for the console.
import { effect, signal } from '@preact/signals';
import { reportWords } from '../core/faults';
import { say } from '../core/language';
import { notices } from '../core/notices';
import { connection, status } from './connection';
import { waits, wordsOfWait } from './waits';
import { consoleName } from './words';

export type LogKind = 'state' | 'asked' | 'done' | 'refused' | 'warning' | 'alarm';
export interface LogLine {
  id: number;
  at: Date;
  kind: LogKind;
  words: string;
  hint: string; // what would have been right
}
const most = 1000;
let last = 0;
export const log = signal<LogLine[]>([]);

export function note(kind: LogKind, words: string, hint = ''): void {
  log.value = [...log.peek().slice(1 - most), { id: ++last, at: new Date(), kind, words, hint }];
}

// Lines that have all the words, in any order and case.
export function search(lines: readonly LogLine[], text: string): LogLine[] {
  const words = text.toLowerCase().split(/\s+/).filter((word) => word !== '');
  return lines.filter((line) => words.every((word) => `${line.kind} ${line.words} ${line.hint}`.toLowerCase().includes(word)));
}

export function followLog(): void {
  let state = '';
  let job = '';
  let trouble = '';
  let waiting = '';
  let noticed = 0;
  effect(() => {
    const now = status.value;
    if (now === null) return;
    if (now.state !== state) {
      const isBad = now.state === 'Alarm' || now.state === 'Fault';
      // Between two lines of the console the machine waits for a moment.
      const isBetween = now.state === 'Line' && now.mdi.streams;
      if (!isBetween) note(isBad ? 'alarm' : 'state', `${say(`state.${now.state}`)}${isBad && now.trouble !== '' ? `: ${reportWords(now.trouble, now.trouble_sentence)}` : ''}`);
      state = now.state;
    }
    const { now: wait } = waits.value;
    const waited = wait === null ? '' : `${wordsOfWait(wait)}${wait.message === '' ? '' : `: ${wait.message.replaceAll('\n', ' · ')}`}`;
    if (waited !== waiting && waited !== '') note('state', waited);
    waiting = waited;
    // What has ended the job may be the trouble that was just told.
    const why = now.job === null || now.job.why === '' || now.job.why === now.trouble ? '' : `, ${reportWords(now.job.why, now.job.why_sentence)}`;
    const words = now.job === null ? '' : `${now.job.name}: ${say(`job.${now.job.state}`)}${why}`;
    // Why a line of the console was refused is told by the console.
    const isTold = now.job?.state === 'failed' && now.job.name === consoleName;
    if (words !== job && words !== '' && !isTold) note(now.job?.state === 'failed' ? 'refused' : 'done', words);
    job = words;
    if (now.mdi.trouble !== trouble && now.mdi.trouble !== '') note('refused', reportWords(now.mdi.trouble, now.mdi.trouble_sentence));
    trouble = now.mdi.trouble;
  });
  effect(() => {
    if (connection.value === 'lost') note('alarm', say('connection.lost'));
  });
  effect(() => {
    for (const one of notices.value) {
      if (one.id > noticed) note(one.kind === 'refused' ? 'refused' : 'done', one.words, one.hint);
      noticed = Math.max(noticed, one.id);
    }
  });
}
