// The start amid a program: what the machine will do, step by step, and where exactly it begins.
import { say } from '../core/language';
import { fromMm, lengthUnit, readLength } from '../core/units';
import { whyNoStart } from '../machine/actions';
import { stepsOf } from '../machine/interrupted';
import { beginThere, changeStart, noStart, startsAt } from '../machine/way_back';
import { Button } from './button';
import { Dialog } from './dialogs';
import { Reported, Steps } from './reported';
import { Typed } from './typed';

const shownLength = (mm: number): string => String(Number(fromMm(mm).toFixed(4)));

export function StartDialog() {
  const now = startsAt.value;
  if (now === null) return null;
  const { way } = now;
  const refused = way !== null && way.code !== '';
  const why = way === null ? say('way.looking') : refused ? say('way.refused') : whyNoStart.value;
  return (
    <Dialog title={say('way.ask', { name: now.program.name, line: way?.line ?? now.line })} onClose={noStart}>
      <div aria-live="polite">
        {way === null && <p class="dim">{say('way.looking')}</p>}
        {refused && (
          <p class="refusal">
            <Reported words={way.why} sentence={way.why_sentence} code={way.code} />
          </p>
        )}
        {way !== null && !refused && (
          <>
            <p>{say('way.what')}</p>
            <Steps steps={stepsOf(way)} />
            <p>{say('way.clear')}</p>
          </>
        )}
      </div>
      <details open={now.pass !== null || now.after > 0 || way?.code === 'reentry.done-often'}>
        <summary>{say('way.where')}</summary>
        <div class="form-fields">
          <label class="form-field">
            <span class="dim">{say('way.pass')}</span>
            <Typed
              inputMode="numeric"
              value={String(now.pass ?? '')}
              placeholder="1"
              take={(text) => {
                const typed = text.trim();
                if (typed === '' || (/^\d{1,9}$/.test(typed) && Number(typed) > 0)) void changeStart({ pass: typed === '' ? null : Number(typed) });
              }}
            />
          </label>
          <label class="form-field">
            <span class="dim">
              {say('way.after')} {lengthUnit()}
            </span>
            <Typed
              inputMode="decimal"
              value={shownLength(now.after)}
              take={(text) => {
                const mm = text.trim() === '' ? 0 : readLength(text);
                if (mm !== undefined && mm >= 0) void changeStart({ after: mm });
              }}
            />
          </label>
        </div>
      </details>
      <div class="dialog-actions">
        <Button onClick={noStart}>{say('frame.cancel')}</Button>
        <Button kind="go" why={why} onClick={beginThere}>
          {say('do.start')}
        </Button>
      </div>
    </Dialog>
  );
}
