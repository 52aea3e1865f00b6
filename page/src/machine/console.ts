// Lines that a person types, whose modes last from line to line; and short programs of the page's own.
import { kept } from '../core/kept';
import { attempt } from '../core/notices';
import { reportWords } from '../core/faults';
import type { Program } from './api';
import { get, post, Refused, remove, upload } from './api';
import { hold, resume } from './actions';
import { status } from './connection';
import { note } from './log';
import { beOwner } from './owner';
import { refreshPrograms } from './programs';
import { consoleName } from './words';

// What is asked of whole programs alone.
const ofPrograms = ['gcode.no-end', 'path.no-units'];
const lookEvery = 120; // ms
const most = 50; // looks

const isLines = (value: unknown): value is string[] => Array.isArray(value) && value.every((one) => typeof one === 'string');
const mostTyped = 100;
export const typed = kept<string[]>('console-lines', [], isLines); // the earlier lines, the last one at the end

// As in grbl, ! holds and ~ goes on.
export async function typeLine(text: string): Promise<boolean> {
  typed.value = [...typed.value.filter((one) => one !== text), text].slice(-mostTyped);
  note('asked', text);
  if (text === '!') return hold();
  if (text === '~') return resume();
  return attempt(async () => {
    await beOwner();
    const { words } = await post<{ words: string[] }>('/mdi', { line: text });
    for (const one of words) note('done', one);
  });
}

// A program of one line or a few, which is checked first. It is in no list.
export async function runLine(text: string, name = consoleName): Promise<boolean> {
  note('asked', text.replaceAll('\n', ' · '));
  return attempt(async () => {
    await beOwner();
    const program = await upload<Program>('/programs', name, `${text}\n`);
    await post(`/programs/${program.id}/run`);
    await tellFindings(program.id);
    // The session has its own copy of what runs.
    await remove(`/programs/${program.id}`);
    await refreshPrograms();
  });
}

async function tellFindings(id: number): Promise<void> {
  for (let looks = 0; looks < most; ++looks) {
    const program = await get<Program>(`/programs/${id}`);
    if (program.state !== 'checking' && status.value?.job?.state !== 'checking') {
      const found = (program.findings ?? []).filter((one) => !ofPrograms.includes(one.code));
      const first = found.find((one) => one.severity === 'error');
      for (const one of found) {
        if (one === first) continue;
        const hint = reportWords(one.expected, one.expected_sentence);
        note(one.severity === 'error' ? 'refused' : 'warning', reportWords(one.message, one.message_sentence), hint);
      }
      // Whoever has asked tells the first error.
      if (first !== undefined) throw new Refused(409, first.code, first.message, first.expected, first.message_sentence, first.expected_sentence);
      return;
    }
    await new Promise((resolve) => setTimeout(resolve, lookEvery));
  }
}
