// The program's text beside the results. A finding picks its line.
import { useMemo } from 'preact/hooks';
import { TextBox } from '../parts/text_box';
import { picked } from '../scene/stage';
import type { CheckFinding } from './answer';
import type { FileText } from './file_text';
import { say } from './words';

export function ProgramLines({ text, findings }: { text: FileText; findings: readonly CheckFinding[] }) {
  const line = useMemo(() => (number: number) => text.line(number), [text]);
  void text.version.value;
  return (
    <TextBox
      text={{ lines: text.lines.value, line }}
      label={say('program')}
      goal={picked.value ?? 0}
      mark={(number) => ({ classes: findings.find((one) => one.line === number)?.severity })}
      classes="check-text"
    />
  );
}
