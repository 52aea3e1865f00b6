// The first board: its front, the parallel port that drives it, and its three motors. Its program is the project's own,
// compiled to WebAssembly.
import './board.css';
import type { JSX } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import type { LabCore, Windings } from '../core';
import { Lesson, Select, Tick } from '../shared';
import { change, follow, view } from '../state';
import { MotorView } from '../steps/MotorView';
import { rotors } from '../view';
import { ViewNumber } from '../ViewNumber';
import { say } from '../words';
import { Held, Panel } from './Panel';
import { type Bench, type Played, useBench } from './play';
import { isOutput, levelOf, pinOf, portPins, type Registers, withLevel, type Wiring } from './port';
import { PortView } from './PortView';
import { PinTable, tableOf, TableSetup } from './Setup';
import { atEnd, axisNames, placeOf, shownPlace, stepsTo } from './table';

const keyOfMode = { waiting: undefined, automatic: '*', manual: '#' } as const;

// What the board gives back: end switches, probe and emergency button, as the table of pins has them.
function withStatus(registers: Registers, wiring: Wiring, played: Played, probe: boolean): Registers {
  const table = tableOf();
  const steps = played.answer.rotors;
  const active = {
    endX: atEnd(table, 0, steps[0] ?? 0), endY: atEnd(table, 1, steps[1] ?? 0), endZ: atEnd(table, 2, steps[2] ?? 0),
    probe, emergency: played.answer.mode === 'reset',
  };
  let now = registers;
  for (const one of portPins) if (!isOutput(one)) now = withLevel(now, one, 0);
  for (const [line, is] of Object.entries(active)) {
    const name = line as keyof typeof active;
    const one = pinOf(wiring, name);
    if (one !== undefined) now = withLevel(now, one, (is ? 1 : 0) ^ (wiring[name].inverted ? 1 : 0));
  }
  return now;
}

export function BoardLab({ core }: { core: LabCore }): JSX.Element {
  const now = view.value;
  const wiring = now.lpt;
  const [probe, setProbe] = useState(false);
  const [bench, played] = useBench(core, wiring, (fresh) => {
    const key = keyOfMode[now.mode];
    if (key !== undefined) fresh.type(key);
    axisNames.forEach((_, axis) => fresh.turn(axis, ((now.down >> axis) & 1) === 1));
    if (now.run) fresh.clock({ axes: now.axes, hertz: now.hz, pulses: -1 });
  });
  const { mode } = played.answer;
  // A link reproduces the mode; what a reset leaves is waiting.
  useEffect(() => {
    const is = bench.answer.mode; // a key that has just been typed has changed it
    if (is !== 'reset' && view.value.mode !== is) follow({ mode: is });
  }, [mode]);
  const registers = withStatus(played.registers, wiring, played, probe);
  return (
    <div class="lab-bench" tabIndex={-1}>
      <Panel bench={bench} played={played} />
      <div class="lab-bench-side">
        <section class="panel lab-turning" aria-label={say('boardMotors')}>
          <h2>{say('boardMotors')}</h2>
          <div class="lab-motors three">
            {axisNames.map((axis, i) => (
              <Motor key={axis} axis={i} played={played} />
            ))}
          </div>
        </section>
        <section class="panel lab-port" aria-label={say('portTitle')}>
          <h2>{say('portTitle')}</h2>
          <PortView
            wiring={wiring} registers={registers}
            onToggle={(pin) => {
              bench.registers = withLevel(bench.registers, pin, 1 - levelOf(bench.registers, pin));
            }}
          />
          <Held class="button" pressed={probe} onHold={setProbe}>{say('touchProbe')}</Held>
          <Lesson>{say('portLesson')}</Lesson>
        </section>
        <ClockPanel bench={bench} />
      </div>
      <div class="lab-halves lab-wide">
        <PinTable />
        <div class="lab-charts">
          <TableSetup />
          <section class="panel lab-charts">
            <Select label={say('rotor')} value={now.rotor} options={rotors.map((value) => ({ value, words: say('fullStepsATurn', { n: value }) }))} onChange={(rotor) => change({ rotor })} />
            <Lesson>{say('boardMotorsLesson')}</Lesson>
            <Lesson>{say('boardLesson')}</Lesson>
          </section>
        </div>
      </div>
    </div>
  );
}

// The arrow keys of the computer's keyboard, while a button for jogging has the focus.
const moveOfKey: Partial<Record<string, readonly [number, boolean]>> = {
  ArrowLeft: [0, false], ArrowRight: [0, true], ArrowDown: [1, false], ArrowUp: [1, true], PageDown: [2, false], PageUp: [2, true],
};

const nameOf = (axis: number, up: boolean): string => `${axis}${up ? '+' : '-'}`;

// Jogging ends wherever its key is released, and where that would not be heard: another element or window has the focus,
// or the page is hidden.
function useRelease(release: () => void): { current: string | undefined } {
  const key = useRef<string | undefined>(undefined); // of the keyboard, that jogs
  const ends = useRef(release);
  ends.current = release;
  useEffect(() => {
    const end = (): void => {
      key.current = undefined;
      ends.current();
    };
    const released = (event: KeyboardEvent): void => {
      if (event.key === key.current) end();
    };
    const hidden = (): void => {
      if (document.hidden) end();
    };
    addEventListener('keyup', released);
    addEventListener('blur', end);
    document.addEventListener('visibilitychange', hidden);
    return () => {
      removeEventListener('keyup', released);
      removeEventListener('blur', end);
      document.removeEventListener('visibilitychange', hidden);
    };
  }, []);
  return key;
}

// The program's control window: a clock on some axes, jogging, and the two heights of Z.
function ClockPanel({ bench }: { bench: Bench }): JSX.Element {
  const now = view.value;
  const table = tableOf();
  const [jogged, setJogged] = useState<string | undefined>();
  const jogs = useRef<string | undefined>(undefined); // at once, where `jogged` is of the last picture
  const start = (axes: number, pulses: number): void => bench.clock({ axes, hertz: now.hz, pulses });
  const stop = (): void => start(0, 0);
  const turn = (axis: number, down: boolean): void => {
    bench.turn(axis, down);
    const bit = 1 << axis;
    change({ down: down ? view.value.down | bit : view.value.down & ~bit });
  };
  // The first start is that of the bench.
  const isShown = useRef(false);
  useEffect(() => {
    if (isShown.current && view.value.run) start(now.axes, -1);
    isShown.current = true;
  }, [now.hz, now.axes]);
  const showJogged = (name: string | undefined): void => {
    jogs.current = name;
    setJogged(name);
  };
  const endJogging = (): void => {
    if (jogs.current === undefined) return;
    stop();
    showJogged(undefined);
  };
  const jog = (axis: number, up: boolean, held: boolean): void => {
    const name = nameOf(axis, up);
    if (held) {
      turn(axis, up === (((now.flip >> axis) & 1) === 1));
      start(1 << axis, -1);
      showJogged(name);
      change({ run: false });
    } else if (jogs.current === name) {
      endJogging();
    }
  };
  const heldKey = useRelease(endJogging);
  // Z on its way to a height is a clock too.
  const runs = now.run || (bench.answer.clock_runs && jogged === undefined);
  const moveZ = (to: number): void => {
    const steps = stepsTo(table, 2, to) - (bench.counted[2] ?? 0);
    change({ run: false });
    if (steps === 0) return;
    turn(2, steps < 0);
    start(4, Math.abs(steps));
  };
  return (
    <section class="panel lab-controls lab-clock" aria-label={say('clockTitle')}>
      <h2>{say('clockTitle')}</h2>
      <ViewNumber name="hz" label={say('clockRate')} unit="Hz" step={5} />
      <div class="lab-axes">
        {axisNames.map((axis, i) => (
          <Tick key={axis} label={say('clockOn', { axis })} checked={((now.axes >> i) & 1) === 1} onChange={() => change({ axes: now.axes ^ (1 << i) })} />
        ))}
        {axisNames.map((axis, i) => (
          <Tick key={`${axis}-`} label={say('downOn', { axis })} checked={bench.isDown(i)} onChange={(down) => turn(i, down)} />
        ))}
      </div>
      <button
        type="button" class={runs ? 'button' : 'button accent'} disabled={now.axes === 0 && !runs}
        onClick={() => {
          change({ run: !runs });
          if (runs) stop();
          else start(now.axes, -1);
        }}
      >
        {say(runs ? 'clockStop' : 'clockStart')}
      </button>
      <div
        class="lab-jog" role="group" aria-label={say('jogTitle')}
        onKeyDown={(event) => {
          const move = moveOfKey[event.key];
          if (move === undefined) return;
          event.preventDefault();
          if (event.repeat) return;
          heldKey.current = event.key;
          jog(move[0], move[1], true);
        }}
        onFocusOut={() => {
          if (heldKey.current === undefined) return;
          heldKey.current = undefined;
          endJogging();
        }}
      >
        <span>{say('jogTitle')}</span>
        {axisNames.flatMap((axis, i) =>
          [false, true].map((up) => (
            <Held key={`${axis}${up}`} class="button" pressed={jogged === nameOf(i, up)} onHold={(held) => jog(i, up, held)}>
              {axis}{up ? '+' : '−'}
            </Held>
          )),
        )}
      </div>
      <div class="lab-buttons">
        <button type="button" class="button" onClick={() => moveZ(now.zclear)}>{say('zToClear')}</button>
        <button type="button" class="button" onClick={() => moveZ(now.zwork)}>{say('zToWork')}</button>
      </div>
      <Lesson>{say('clockLesson')}</Lesson>
    </section>
  );
}

// The winding's pattern as the board shows it. Without a current the rotor stays where it was.
function windingsOf(pattern: number, place: number, fullSteps: number): Windings {
  const on = (output: number): number => (pattern >> output) & 1;
  return {
    first: place, steps_per_full_step: 1, pattern: [pattern], phase_a: [on(0) - on(2)], phase_b: [on(1) - on(3)],
    degrees: [(place * 360) / fullSteps],
  };
}

function Motor({ axis, played }: { axis: number; played: Played }): JSX.Element {
  const fullSteps = Number(view.value.rotor);
  const table = tableOf();
  const place = played.answer.rotors[axis] ?? 0;
  const counted = played.counted[axis] ?? 0;
  const unit = say(table.unit === 'mm' ? 'unitMm' : 'unitInch');
  const differs = place !== counted;
  return (
    <div class="lab-axis" data-axis={axisNames[axis]}>
      <MotorView axis={axisNames[axis] ?? ''} windings={windingsOf(played.answer.patterns[axis] ?? 0, place, fullSteps)} place={place} fullSteps={fullSteps} />
      <dl class={differs ? 'lab-places differ' : 'lab-places'}>
        <div><dt>{say('axisPlace')}</dt><dd data-place>{shownPlace(table, placeOf(table, axis, place))} {unit}</dd></div>
        <div><dt>{say('countedPlace')}</dt><dd data-counted>{shownPlace(table, placeOf(table, axis, counted))} {unit}</dd></div>
      </dl>
    </div>
  );
}
