// The one question that may be open, and what the page tells in passing.
import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { say } from '../core/language';
import { dismiss, notices } from '../core/notices';
import { asked } from '../core/question';
import { hold, stop, whyNoHold } from '../machine/actions';
import { AskedValues, whyNoAnswer } from './asked_values';
import { Button } from './button';
import { FactsTable } from './facts_table';
import { Icon } from './icon';
import { Steps } from './reported';

// A dialog covers the page. While something moves, hold and stop are within reach here, too.
export function Dialog({ title, onClose, children }: { title: string; onClose: () => void; children: ComponentChildren }) {
  const box = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    box.current?.showModal();
  }, []);
  return (
    <dialog ref={box} class="dialog" aria-label={title} onClose={onClose} onCancel={onClose}>
      <h2>{title}</h2>
      {children}
      {whyNoHold.value === '' && (
        <div class="dialog-actions moving">
          <Button kind="hold" icon="hold" onClick={hold} children={say('do.hold')} />
          <Button kind="stop" icon="stop" onClick={stop} children={say('do.stop')} />
        </div>
      )}
    </dialog>
  );
}

export function QuestionDialog() {
  const question = asked.value;
  if (question === null) return null;
  return (
    <Dialog title={question.title} onClose={() => question.answer(false)} key={question.title}>
      {question.facts[0] !== undefined && <p>{question.facts[0]}</p>}
      {question.rows !== undefined && question.rows.length > 0 && <FactsTable columns={question.columns} rows={question.rows} />}
      <AskedValues question={question} />
      {question.steps !== undefined && <Steps steps={question.steps} />}
      {question.facts.slice(1).map((fact) => (
        <p key={fact}>{fact}</p>
      ))}
      <div class="dialog-actions">
        <Button onClick={() => question.answer(false)}>{say('frame.cancel')}</Button>
        <Button kind={question.kind === 'plain' ? 'accent' : question.kind} why={whyNoAnswer(question)} onClick={() => question.answer(true)}>
          {question.yes}
        </Button>
      </div>
    </Dialog>
  );
}

export function Notices() {
  return (
    <div class="notices" role="log" aria-live="polite" aria-label={say('console.log')}>
      {notices.value.map((one) => (
        <div key={one.id} class={`notice ${one.kind}`}>
          <Icon name={one.kind === 'refused' ? 'warn' : 'calm'} />
          <span>{one.words}</span>
          <button type="button" class="bare" aria-label={say('frame.close')} onClick={() => dismiss(one.id)}>
            <Icon name="close" />
          </button>
        </div>
      ))}
    </div>
  );
}
