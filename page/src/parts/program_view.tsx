// The program's text. It follows the executed line until somebody scrolls; a click on a line shows its place.
import { signal } from '@preact/signals';
import { useMemo } from 'preact/hooks';
import { say } from '../core/language';
import { reportWords } from '../core/faults';
import { status } from '../machine/connection';
import { ProgramText } from '../machine/program_text';
import { shown } from '../machine/programs';
import { isUnderWay } from '../machine/words';
import { picked } from '../scene/stage';
import { PickedLine } from './picked_line';
import { TextBox, type LineMark } from './text_box';

const follows = signal(true);

export function ProgramView() {
  const program = shown.value;
  const text = useMemo(() => (program === null ? null : new ProgramText(program.id, program.lines)), [program?.id, program?.lines]);
  const line = useMemo(() => (number: number) => text?.line(number), [text]);
  if (program === null || text === null) return null;
  void text.version.value;

  const now = status.value;
  const runs = now !== null && isUnderWay(now.job) && now.job?.program === program.id;
  const executed = runs ? now.line : 0;
  const mark = (number: number): LineMark => {
    const finding = program.findings?.find((one) => one.line === number);
    return {
      classes: finding?.severity,
      executed: number === executed,
      title: finding === undefined ? undefined : reportWords(finding.message, finding.message_sentence),
    };
  };
  return (
    <TextBox
      text={{ lines: text.lines, line }}
      label={say('run.program')}
      goal={follows.value && executed > 0 ? executed : (picked.value ?? 0)}
      mark={mark}
      locked={runs}
      onScroll={() => {
        if (runs) follows.value = false;
      }}
    >
      {!runs && <PickedLine />}
      {runs && !follows.value && (
        <button type="button" class="chip text-follow" onClick={() => (follows.value = true)}>
          {say('run.follow')}
        </button>
      )}
    </TextBox>
  );
}
