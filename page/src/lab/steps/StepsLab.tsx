// Which axis steps next: one move on the grid, by one method or by two, beat by beat, with its motors.
import type { JSX } from 'preact';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import { type Interpolation, isFailed, type LabCore, type Rule, type Windings } from '../core';
import { beatAt, secondsFor, shareOf, usePlaying } from '../play';
import { Figure, Lesson, NumberField, Refused, Segments, Select, short } from '../shared';
import { change, view } from '../state';
import { type AxisName, axisNames, farthest, type LabView, type MethodCode, methodOf, methodsFor, mostMotors, moveOf, rightOf, rotors, wholeMove } from '../view';
import { cellText, columnWords, driveWords, methodLesson, methodWords, refusal, ruleWords, say } from '../words';
import { driveNames, ruleNames } from '../core';
import { ViewNumber } from '../ViewNumber';
import { CodeView, hasCode, Quadrants } from './CodeView';
import { Grid, type Played } from './Grid';
import { MotorView } from './MotorView';
import { startOf, Strips } from './Strips';
import { BeatTable, Comparison, feedText } from './Tables';

const evenBelow = 1.05; // fastest step over the slowest

export function StepsLab({ core }: { core: LabCore }): JSX.Element {
  const now = view.value;
  const move = moveOf(now);
  const asked = JSON.stringify([move, now.a, now.b]);
  const answers = useMemo(
    () => ({
      a: core.interpolation(methodOf(now.a), move),
      b: now.b === 'none' ? undefined : core.interpolation(methodOf(now.b), move),
      all: core.comparison(move),
    }),
    [core, asked],
  );
  const [playing, setPlaying] = useState(false);
  const clock = isFailed(answers.a) ? [] : answers.a.clock[now.rule];
  const [share, setShare] = useState(() => shareOf(clock, now.beat));
  const shareNow = useRef(share);
  shareNow.current = share;
  useEffect(() => {
    if (!playing) setShare(shareOf(clock, now.beat));
  }, [asked, now.beat, now.rule]);
  useEffect(() => setPlaying(false), [asked]);
  usePlaying(playing, secondsFor(clock.length), () => shareNow.current, setShare, () => setPlaying(false));

  const goBy = useRef<(by: number) => void>(() => undefined);
  useKeys(goBy);

  // A refused move has no pulses; its grid and its fields stay, so that another end can be chosen.
  const a = isFailed(answers.a) ? withoutPulses(now) : answers.a;
  const beat = beatAt(clock, share);
  const goTo = (to: number): void => {
    setPlaying(false);
    const bounded = Math.min(a.pulses, Math.max(0, to));
    setShare(shareOf(clock, bounded));
    change({ beat: bounded >= a.pulses ? wholeMove : bounded });
  };
  goBy.current = (by) => goTo(beat + by);
  const play = (): void => {
    if (playing) goTo(beat);
    else setPlaying(true);
  };
  const played: Played[] = [{ answer: a, beat, mark: 'mark-a' }];
  if (answers.b && !isFailed(answers.b)) {
    played.push({ answer: answers.b, beat: beatAt(answers.b.clock[now.rule], share), mark: 'mark-b' });
  }
  const [across, up] = [axisNames.indexOf(now.across), axisNames.indexOf(now.up)];
  const seen = played.map((one) => ({ ...one, answer: seenOn(one.answer, move.ends, across, up) }));
  const ends = move.arc ? [move.to.x, move.to.y] : now.to;
  const seenEnd: [number, number] = [ends[across] ?? 0, ends[up] ?? 0];
  const windings = (axis: number): Windings | undefined => windingsOf(core, played[0], axis);
  const [first, second] = [windings(across), windings(up)];
  const place = (axis: number): number =>
    beat > 0 ? (a.places[axis]?.[beat - 1] ?? 0) : startOf({ answer: a, beat: 0, mark: 'mark-a' }, axis);
  const setEnd = (axis: number, value: number): void =>
    change({ to: now.to.map((end, i) => (i === axis ? bound(Math.round(value), -farthest) : end)) });
  const hasMidlines = !move.arc && ['master-slave', 'lean', 'listing:rounding', 'listing:shared-variable'].includes(a.name);
  const choose = (code: MethodCode): void => change({ a: code, b: rightOf(code) ?? now.b });
  return (
    <div class="lab-steps">
      <div class="panel lab-stage">
        <div class="lab-player">
          <button type="button" class="button" onClick={() => goTo(0)} aria-label={say('toStart')}><PlayerIcon shape="M6 5v14M20 5L9 12l11 7z" /></button>
          <button type="button" class="button" onClick={() => goTo(beat - 1)} aria-label={say('back')}><PlayerIcon shape="M17 5L7 12l10 7z" /></button>
          <button type="button" class="button lab-play" onClick={play}>{playing ? say('pause') : say('play')}</button>
          <button type="button" class="button" onClick={() => goTo(beat + 1)} aria-label={say('next')}><PlayerIcon shape="M7 5l10 7-10 7z" /></button>
          <button type="button" class="button" onClick={() => goTo(a.pulses)} aria-label={say('toEnd')}><PlayerIcon shape="M18 5v14M4 5l11 7-11 7z" /></button>
          <input
            type="range"
            min={0}
            max={a.pulses}
            value={beat}
            aria-label={say('pulse')}
            onInput={(event) => goTo(Number(event.currentTarget.value))}
          />
          <output>{`${beat} / ${a.pulses}`}</output>
        </div>
        {isFailed(answers.a) ? <Refused words={refusal(answers.a.error)} /> : <JudgementLine played={played} beat={beat} quiet={playing} />}
        {answers.b && isFailed(answers.b) && <Refused words={`B · ${refusal(answers.b.error)}`} />}
        {a.fault && <FaultLine code={now.a} answer={a} />}
        <Grid
          played={seen}
          start={move.arc ? [move.from.x, move.from.y] : [0, 0]}
          end={seenEnd}
          share={share}
          {...(hasMidlines ? { longest: Math.max(...now.to.map(Math.abs)) } : {})}
          {...(move.arc ? { centre: [0, 0] as const, onStart: (to: [number, number]) => change({ radius: bound(Math.abs(to[0]), 1), end: now.end }) } : {})}
          onEnd={([x, y]) => {
            if (move.arc) change({ end: [x, y] });
            else if (x !== 0 || y !== 0) {
              change({ to: now.to.map((end, i) => (i === across ? bound(x, -farthest) : i === up ? bound(y, -farthest) : end)) });
            }
          }}
        />
      </div>
      <div class="panel lab-controls">
        <Segments
          label={say('shape')}
          value={now.shape}
          options={[{ value: 'line', words: say('line') }, { value: 'arc', words: say('arc') }]}
          onChange={(shape) => change({ shape, beat: wholeMove })}
        />
        {move.arc ? (
          <>
            <Segments
              label={say('sense')}
              value={now.cw ? 'cw' : 'ccw'}
              options={[{ value: 'ccw', words: '↺ G3' }, { value: 'cw', words: '↻ G2' }]}
              onChange={(sense) => change({ cw: sense === 'cw' })}
            />
            <ViewNumber name="radius" label={say('radius')} unit={say('steps')} step={1} />
          </>
        ) : (
          <>
            <div class="lab-pair">
              {now.to.map((value, axis) => (
                <NumberField
                  key={axis}
                  label={`${say('end')} ${motorName(axis)}`}
                  value={value}
                  step={1}
                  from={-farthest}
                  to={farthest}
                  onChange={(to) => setEnd(axis, to)}
                />
              ))}
            </div>
            <div class="lab-motor-count">
              {now.to.length < mostMotors && <button type="button" class="button" onClick={() => change({ to: [...now.to, 3] })}>{say('addMotor')}</button>}
              {now.to.length > 2 && <button type="button" class="button" onClick={() => change({ to: now.to.slice(0, -1) })}>{say('removeMotor')}</button>}
            </div>
            {now.to.length > 2 && (
              <div class="lab-pair">
                <AxisChoice label={say('across')} value={now.across} motors={now.to.length} onChange={(name) => change({ across: name, up: name === now.up ? now.across : now.up })} />
                <AxisChoice label={say('up')} value={now.up} motors={now.to.length} onChange={(name) => change({ up: name, across: name === now.across ? now.up : now.across })} />
              </div>
            )}
          </>
        )}
        <MethodChoice label={`A · ${say('method')}`} value={now.a} shape={now.shape} motors={now.to.length} onChange={(code) => code !== 'none' && choose(code)} />
        <MethodChoice label={`B · ${say('beside')}`} value={now.b} shape={now.shape} motors={now.to.length} none onChange={(b) => change({ b })} />
        <Select label={say('duration')} value={now.rule} options={ruleNames.map((value) => ({ value, words: ruleWords(value) }))} onChange={(rule) => change({ rule })} />
        <dl class="lab-figures">
          {played.filter(({ answer }) => answer.pulses > 0).map(({ answer, mark }) => (
            <>
              <Figure name={say('largestError')} value={answer.largest.toFixed(3)} unit={say('steps')} mark={mark} />
              <Figure name={say('meanError')} value={answer.mean.toFixed(3)} unit={say('steps')} mark={mark} />
              <Figure
                name={say('pulsePattern')}
                value={answer.ratio[now.rule] < evenBelow ? say('even') : `${short(answer.ratio[now.rule])} : 1`}
                mark={mark}
              />
            </>
          ))}
        </dl>
        <Lesson>{methodLesson(now.a)}</Lesson>
      </div>
      <section class="panel lab-wide">
        <h2>{say('stripsTitle')}</h2>
        <Lesson>{say('stripsLesson')}</Lesson>
        <Strips
          played={played}
          names={[`A · ${methodWords(now.a)}`, now.b === 'none' ? '' : `B · ${methodWords(now.b)}`]}
          rule={now.rule}
          share={share}
          windings={first}
          motor={across}
          onSeek={(to) => goTo(beatAt(clock, to))}
        />
      </section>
      <div class="lab-halves lab-wide">
      <section class="panel">
        <h2>{say('motorsTitle')}</h2>
        <Lesson>{say('motorsLesson')}</Lesson>
        <div class="lab-pair">
          <Select label={say('drive')} value={now.drive} options={driveNames.map((value) => ({ value, words: driveWords(value) }))} onChange={(drive) => change({ drive })} />
          <Select label={say('rotor')} value={now.rotor} options={rotors.map((value) => ({ value, words: say('fullStepsATurn', { n: value }) }))} onChange={(rotor) => change({ rotor })} />
        </div>
        <div class="lab-motors">
          {first && <MotorView axis={motorName(across)} windings={first} place={place(across)} fullSteps={Number(now.rotor)} />}
          {second && <MotorView axis={motorName(up)} windings={second} place={place(up)} fullSteps={Number(now.rotor)} />}
        </div>
      </section>
      <section class="panel">
        <h2>{say('beatsTitle')}</h2>
        <Lesson>{say('beatsLesson')}</Lesson>
        {!move.arc && hasCode(a) && <CodeView answer={a} beat={beat} />}
        {!move.arc && (a.name === 'point-comparison' || a.name === 'listing:projection') && <Quadrants end={[move.to.x, move.to.y]} />}
        <BeatTable answer={a} beat={beat} onBeat={goTo} />
      </section>
      </div>
      <section class="panel lab-wide">
        <h2>{say('comparison')}</h2>
        <Lesson>{say('comparisonLesson')}</Lesson>
        {!isFailed(answers.all) && (
          <Comparison methods={answers.all.methods} a={now.a} b={now.b} rule={now.rule} onA={(code) => change({ a: code })} onB={(code) => change({ b: code })} />
        )}
      </section>
    </div>
  );
}

function PlayerIcon({ shape }: { shape: string }): JSX.Element {
  return (
    <svg class="lab-icon" viewBox="0 0 24 24" aria-hidden="true">
      <path d={shape} />
    </svg>
  );
}

const bound = (value: number, low: number): number => Math.min(farthest, Math.max(low, value));

const motorName = (axis: number): string => (axisNames[axis] ?? '').toUpperCase();

// The keys work wherever the focus is, except where a character is typed: a link opens without any focus.
function useKeys(goBy: { current: (by: number) => void }): void {
  useEffect(() => {
    const pressed = (event: KeyboardEvent): void => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const at = event.target;
      const typing = at instanceof HTMLInputElement ? !['range', 'radio', 'checkbox'].includes(at.type) : at instanceof HTMLTextAreaElement;
      if (typing || (event.key !== '.' && event.key !== ',')) return;
      goBy.current(event.key === '.' ? 1 : -1);
      event.preventDefault();
    };
    addEventListener('keydown', pressed);
    return () => removeEventListener('keydown', pressed);
  }, []);
}

// What is shown of a move that the method refuses: its ideal path.
function withoutPulses(now: LabView): Interpolation {
  const { from, to } = moveOf(now);
  const axes = now.shape === 'arc' ? 2 : now.to.length;
  const byRule = <T,>(make: () => T): Record<Rule, T> => ({ beats: make(), roots: make(), exact: make() });
  const lists = (): number[][] => Array.from({ length: axes }, () => []);
  return {
    ...methodOf(now.a), title: '', pulses: 0, together: 0, idle: 0, largest: 0, mean: 0, length: 0,
    lag: byRule(() => 0), ratio: byRule(() => 1), clock: byRule(() => []),
    ideal: { x: [from.x, to.x], y: [from.y, to.y] },
    steps: [], directions: [], x: [], y: [], foot_x: [], foot_y: [], deviation: [],
    judge: {}, decisions: {}, end: {}, places: lists(), feet: lists(),
  };
}

// The answer as the grid sees it: two of the axes.
function seenOn(answer: Interpolation, ends: readonly number[] | undefined, across: number, up: number): Interpolation {
  if (!ends) return answer;
  return {
    ...answer,
    x: answer.places[across] ?? [],
    y: answer.places[up] ?? [],
    foot_x: answer.feet[across] ?? [],
    foot_y: answer.feet[up] ?? [],
    ideal: { x: [0, ends[across] ?? 0], y: [0, ends[up] ?? 0] },
  };
}

// What a faulty listing gets wrong on this move.
function FaultLine({ code, answer }: { code: MethodCode; answer: Interpolation }): JSX.Element | null {
  const { fault } = answer;
  if (!fault) return null;
  const right = rightOf(code);
  const first = fault.first === 0 ? say('faultNone') : say(fault.first > answer.pulses ? 'faultMissing' : 'faultFirst', { n: fault.first });
  const end = fault.ends_right ? '' : say('faultEnd', { end: `(${fault.end.join(', ').replaceAll('-', '−')})` });
  return <Refused words={[first, end, right ? say('faultRight', { method: methodWords(right) }) : ''].filter((one) => one !== '').join(' ')} />;
}

function AxisChoice({ label, value, motors, onChange }: { label: string; value: AxisName; motors: number; onChange: (name: AxisName) => void }): JSX.Element {
  return <Select label={label} value={value} options={axisNames.slice(0, motors).map((name) => ({ value: name, words: name.toUpperCase() }))} onChange={onChange} />;
}

function windingsOf(core: LabCore, played: Played | undefined, axis: number): Windings | undefined {
  const { drive, rotor } = view.value;
  const places = played?.answer.places[axis];
  const start = played ? startOf(played, axis) : 0;
  const [low, high] = [Math.min(start, ...(places ?? [])), Math.max(start, ...(places ?? []))];
  return useMemo(() => {
    const answer = core.windings(drive, Number(rotor), low, high);
    return isFailed(answer) ? undefined : answer;
  }, [core, drive, rotor, low, high]);
}

interface MethodChoiceProps {
  label: string;
  value: MethodCode | 'none';
  shape: 'line' | 'arc';
  motors: number;
  none?: boolean;
  onChange: (code: MethodCode | 'none') => void;
}
function MethodChoice({ label, value, shape, motors, none = false, onChange }: MethodChoiceProps): JSX.Element {
  const codes: (MethodCode | 'none')[] = [...(none ? (['none'] as const) : []), ...methodsFor(shape, motors)];
  return (
    <Select
      label={label}
      value={value}
      options={codes.map((code) => ({ value: code, words: code === 'none' ? say('noMethod') : methodWords(code) }))}
      onChange={onChange}
    />
  );
}

// What was judged before the present pulse, which axis it fed, and how far from the path the tool now stands.
function JudgementLine({ played, beat, quiet }: { played: readonly Played[]; beat: number; quiet: boolean }): JSX.Element {
  const answer = played[0]?.answer;
  if (!answer || beat === 0) {
    return <p class="lab-judgement" aria-live={quiet ? 'off' : 'polite'}>{say('atStart')}</p>;
  }
  const judged = Object.entries(answer.judge)
    .map(([name, cells]) => (name === 'judge' ? '' : `${columnWords(name)} = `) + cellText(cells[beat - 1] ?? ''))
    .join(', ');
  return (
    <p class="lab-judgement" aria-live={quiet ? 'off' : 'polite'}>
      <span>{say('pulse')} <b>{beat}</b></span>
      <span class="lab-judged">{judged}</span>
      <span>→ <b class="lab-feed">{feedText(answer, beat - 1)}</b></span>
      <span>({answer.places.map((places) => places[beat - 1] ?? 0).join(', ').replaceAll('-', '−')})</span>
      <span>{say('error')} <b>{(answer.deviation[beat - 1] ?? 0).toFixed(3)}</b> {say('steps')}</span>
    </p>
  );
}
