// Lines that a person types: each is checked, and run as a program of its own.
import { attempt } from '../core/notices';
import { toldOr } from '../core/told';
import type { Program } from './api';
import { get, post, remove, upload } from './api';
import { status } from './connection';
import { note } from './log';
import { beOwner } from './owner';
import { refreshPrograms } from './programs';
import { consoleName } from './words';

// What is asked of whole programs alone.
const ofPrograms = ['gcode.no-end', 'path.no-units'];
const lookEvery = 120; // ms
const most = 50; // looks

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
      for (const one of program.findings ?? []) {
        if (!ofPrograms.includes(one.code)) note(one.severity === 'error' ? 'refused' : 'warning', `${toldOr(one.message)}. ${toldOr(one.expected)} [${one.code}]`);
      }
      const first = program.findings?.find((one) => one.severity === 'error');
      if (first !== undefined) throw new Error(first.message);
      return;
    }
    await new Promise((resolve) => setTimeout(resolve, lookEvery));
  }
}
