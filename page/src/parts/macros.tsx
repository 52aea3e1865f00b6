// The buttons of the macros. Without a folder of macros there is nothing.
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { reportWords } from '../core/faults';
import { whyNoSetUp } from '../machine/actions';
import { isLive } from '../machine/connection';
import { macroFindings, macros, refreshMacros, runMacro } from '../machine/macros';
import { Button } from './button';

export function Macros() {
  // The folder may have changed since.
  useEffect(() => {
    if (isLive.value) void refreshMacros();
  }, []);
  if (macros.value.length === 0 && macroFindings.value.length === 0) return null;
  return (
    <section class="panel set-up" aria-label={say('macro.title')}>
      <h2>{say('macro.title')}</h2>
      <div class="set-up-buttons">
        {macros.value.map((one) => (
          <Button key={one.name} why={whyNoSetUp()} onClick={() => runMacro(one)}>
            {one.title}
            {one.key === '' ? '' : ` (${one.key})`}
          </Button>
        ))}
      </div>
      {macroFindings.value.map((one) => (
        <p key={`${one.code} ${one.message}`} class="refusal">
          {reportWords(one.message, one.message_sentence)} [{one.code}]
        </p>
      ))}
    </section>
  );
}
