// The console: lines of G-code, and the log of what has happened.
import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { language, say } from '../core/language';
import { whyNotOurs } from '../machine/actions';
import { status } from '../machine/connection';
import { typed, typeLine } from '../machine/console';
import { log, search, type LogKind } from '../machine/log';
import { placeWords } from '../machine/place';
import { Icon, type IconName } from '../parts/icon';

const sought = signal('');
const mostShown = 400;

const icons: Record<LogKind, IconName> = { state: 'machine', asked: 'console', done: 'calm', refused: 'warn', warning: 'warn', alarm: 'bad' };

function Line() {
  const field = useRef<HTMLInputElement>(null);
  const back = useRef(0); // how far up in the earlier lines
  const why = whyNotOurs();
  const send = async (event: SubmitEvent): Promise<void> => {
    event.preventDefault();
    const text = field.current?.value.trim() ?? '';
    if (text === '' || why !== '' || field.current === null) return;
    field.current.value = '';
    back.current = 0;
    const taken = await typeLine(text);
    // What was refused can be corrected.
    if (!taken && field.current?.value === '') field.current.value = text;
    field.current?.focus();
  };
  const recall = (event: KeyboardEvent): void => {
    const way = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0;
    if (way === 0 || field.current === null) return;
    event.preventDefault();
    back.current = Math.min(typed.value.length, Math.max(0, back.current + way));
    field.current.value = back.current === 0 ? '' : (typed.value.at(-back.current) ?? '');
  };
  return (
    <form class="console-line" onSubmit={send}>
      <label class="unseen" for="line">
        {say('console.type')}
      </label>
      <input
        id="line"
        ref={field}
        type="text"
        autocomplete="off"
        autocapitalize="characters"
        spellcheck={false}
        placeholder={say('console.type')}
        onKeyDown={recall}
      />
      <button class="button accent" type="submit" aria-disabled={why !== ''} title={why === '' ? undefined : why}>
        {say('console.send')}
      </button>
    </form>
  );
}

// What counts for the next line.
function Modes() {
  const mdi = status.value?.mdi;
  if (mdi === undefined) return null;
  const feed = Number((mdi.codes.includes('G20') ? mdi.feed / 25.4 : mdi.feed).toFixed(3));
  return (
    <p class="modes" role="group" aria-label={say('console.modes')} data-testid="modes">
      {[...mdi.codes, `T${mdi.tool}`, `F${feed}`, `S${mdi.speed}`].map((code) => (
        <code key={code}>{code}</code>
      ))}
      <span class="figure">{placeWords(mdi.place)}</span>
    </p>
  );
}

export function ConsolePage() {
  const end = useRef<HTMLDivElement>(null);
  const lines = search(log.value, sought.value).slice(-mostShown);
  useEffect(() => end.current?.scrollIntoView({ block: 'end' }), [lines.length]);
  return (
    <div class="console">
      <section class="panel log" aria-label={say('console.log')}>
        <div class="console-search">
          <Icon name="search" />
          <input
            type="search"
            aria-label={say('console.search')}
            placeholder={say('console.search')}
            value={sought.value}
            onInput={(event) => (sought.value = event.currentTarget.value)}
          />
        </div>
        <div class="log-lines" role="log" aria-label={say('console.log')} tabIndex={0}>
          {lines.length === 0 && <p class="dim">{say(sought.value === '' ? 'console.empty' : 'console.nothing')}</p>}
          {lines.map((line) => (
            <div class={`log-line ${line.kind === 'state' ? '' : line.kind}`} key={line.id}>
              <time>{line.at.toLocaleTimeString(language.value)}</time>
              <Icon name={icons[line.kind]} />
              <span>
                {line.words}
                {line.hint !== '' && ' '}
                {line.hint !== '' && <span class="dim log-hint">{say('files.expected', { expected: line.hint })}</span>}
              </span>
            </div>
          ))}
          <div ref={end} />
        </div>
      </section>
      <section class="panel" aria-label={say('console.title')}>
        <Modes />
        <Line />
        <p class="dim">{say('console.help')}</p>
      </section>
    </div>
  );
}
