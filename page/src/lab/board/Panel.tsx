// The board's front: keypad, LEDs, the tool's relay and button, the emergency button.
import type { ComponentChildren, JSX, RefObject } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import { isTyping } from '../../core/typing';
import { say } from '../words';
import { type Bench, type KeyName, keyNames, type Played } from './play';

// Rows of the keypad; the keys stand in the order of keyNames.
const moves: Partial<Record<KeyName, string>> = {
  '1': 'X− Y+', '2': 'Y+', '3': 'X+ Y+', '4': 'X−', '5': 'Z+', '6': 'X+', '7': 'X− Y−', '8': 'Y−', '9': 'X+ Y−', '0': 'Z−',
};

interface HeldProps {
  class: string;
  pressed: boolean;
  onHold: (held: boolean) => void;
  children: ComponentChildren;
}
// A button that acts as long as it is held: by a finger, the mouse or Enter. The space bar holds the machine, as on every page.
export function Held({ class: name, pressed, onHold, children }: HeldProps): JSX.Element {
  const isKey = (event: KeyboardEvent): boolean => event.key === 'Enter';
  return (
    <button
      type="button" class={name} aria-pressed={pressed}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        onHold(true);
      }}
      onPointerUp={() => onHold(false)}
      onPointerCancel={() => onHold(false)}
      onLostPointerCapture={() => onHold(false)}
      onKeyDown={(event) => {
        if (!isKey(event) || event.repeat) return;
        event.preventDefault();
        onHold(true);
      }}
      onKeyUp={(event) => isKey(event) && onHold(false)}
      onBlur={() => onHold(false)}
      onContextMenu={(event) => event.preventDefault()}
    >
      {children}
    </button>
  );
}

// Which keys are down: those on the screen, and those of the keyboard while `area` has the focus. There a digit is a key of
// the board, not the shortcut of a page.
function useKeys(bench: Bench, area: RefObject<HTMLElement | null>): [number, (key: KeyName, down: boolean) => void] {
  const [keys, setKeys] = useState(0);
  const hold = (key: KeyName, down: boolean): void => {
    const bit = 1 << keyNames.indexOf(key);
    bench.keys = down ? bench.keys | bit : bench.keys & ~bit;
    setKeys(bench.keys);
  };
  useEffect(() => {
    const here = area.current?.closest<HTMLElement>('.lab-bench');
    if (!here) return;
    if (document.activeElement === document.body) here.focus({ preventScroll: true });
    // A key that is released may have another name by then: # is Shift with 3.
    const down = new Map<string, KeyName>();
    const release = (): void => {
      for (const key of down.values()) hold(key, false);
      down.clear();
    };
    const pressed = (event: KeyboardEvent): void => {
      const key = keyNames.find((name) => name === event.key);
      if (key === undefined || event.metaKey || isTyping(event.target)) return;
      event.stopPropagation();
      if (event.repeat) return;
      down.set(event.code, key);
      hold(key, true);
    };
    const released = (event: KeyboardEvent): void => {
      const key = down.get(event.code);
      if (key === undefined) return;
      down.delete(event.code);
      hold(key, false);
    };
    here.addEventListener('keydown', pressed);
    addEventListener('keyup', released);
    addEventListener('blur', release);
    document.addEventListener('visibilitychange', release);
    return () => {
      release();
      here.removeEventListener('keydown', pressed);
      removeEventListener('keyup', released);
      removeEventListener('blur', release);
      document.removeEventListener('visibilitychange', release);
    };
  }, [bench]);
  return [keys, hold];
}

interface LedProps {
  name: string;
  words: string;
  lit: boolean;
}
function Led({ name, words, lit }: LedProps): JSX.Element {
  return (
    <li class={lit ? 'lab-led lit' : 'lab-led'} data-led={name}>
      <i aria-hidden="true" />
      <b>{name}</b>
      <span>{words}</span>
      <span class="unseen">{say(lit ? 'ledLit' : 'ledDark')}</span>
    </li>
  );
}

export function Panel({ bench, played }: { bench: Bench; played: Played }): JSX.Element {
  const area = useRef<HTMLElement | null>(null);
  const [keys, hold] = useKeys(bench, area);
  const [button, setButton] = useState(false);
  const { answer } = played;
  const [rb0, rd1, rd2, rd3] = answer.leds;
  return (
    <section class="panel lab-front" ref={area} aria-label={say('boardFront')}>
      <h2>{say('boardFront')}</h2>
      <p class="lab-mode" role="status" data-mode={answer.mode}>{say(`mode_${answer.mode}`)}</p>
      <div class="lab-keypad" role="group" aria-label={say('keypad')}>
        {keyNames.map((key, i) => (
          <Held
            key={key} class="lab-key"
            pressed={((keys >> i) & 1) === 1} onHold={(down) => hold(key, down)}
          >
            <b>{key}</b>
            <small>{moves[key] ?? say(key === '#' ? 'keyManual' : 'keyAutomatic')}</small>
          </Held>
        ))}
      </div>
      <p class="lab-hint">{say('keypadHint')}</p>
      <ul class="lab-leds">
        <Led name="RB0" words={say('ledAutomatic')} lit={rb0 === 1} />
        <Led name="RD1" words={say('ledWaitingUp')} lit={rd1 === 1} />
        <Led name="RD2" words={say('ledWaiting')} lit={rd2 === 1} />
        <Led name="RD3" words={say('ledWaiting')} lit={rd3 === 1} />
        <Led name="RE2" words={say('ledRelay')} lit={answer.relay_led} />
      </ul>
      <div class="lab-board-buttons">
        <Held
          class="button" pressed={button}
          onHold={(down) => {
            bench.button = down;
            setButton(down);
          }}
        >
          {say('toolButton')}
        </Held>
        <span class={answer.relay ? 'lab-relay on' : 'lab-relay'} data-relay={answer.relay ? 'closed' : 'open'}>
          <svg viewBox="0 0 64 28" aria-hidden="true">
            <path d={answer.relay ? 'M4 20H20L46 20H60' : 'M4 20H20L44 6M46 20H60'} />
            <circle cx="20" cy="20" r="3" />
            <circle cx="46" cy="20" r="3" />
          </svg>
          {say(answer.relay ? 'relayClosed' : 'relayOpen')}
        </span>
        <Held
          class="button lab-emergency" pressed={bench.isReset}
          onHold={(down) => {
            if (down !== bench.isReset) bench.reset(down);
          }}
        >
          {say('emergencyButton')}
        </Held>
      </div>
    </section>
  );
}
