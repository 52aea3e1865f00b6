// Which axis steps next: one move on the grid, by one method or by two, beat by beat, with its motors.
import type { JSX } from 'preact';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import { isFailed, type LabCore, type Windings } from '../core';
import { beatAt, secondsFor, shareOf, usePlaying } from '../play';
import { Figure, Lesson, NumberField, Refused, Segments, Select, short } from '../shared';
import { change, view } from '../state';
import { farthest, type MethodCode, methodOf, methodsFor, moveOf, rotors, wholeMove } from '../view';
import { driveWords, methodLesson, methodWords, ruleWords, say } from '../words';
import { driveNames, ruleNames } from '../core';
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

  if (isFailed(answers.a)) return <Refused words={answers.a.error} />;
  const a = answers.a;
  const beat = beatAt(clock, share);
  const goTo = (to: number): void => {
    setPlaying(false);
    const bounded = Math.min(a.pulses, Math.max(0, to));
    setShare(shareOf(clock, bounded));
    change({ beat: bounded >= a.pulses ? wholeMove : bounded });
  };
  const play = (): void => {
    if (playing) goTo(beat);
    else setPlaying(true);
  };
  const played: Played[] = [{ answer: a, beat, mark: 'mark-a' }];
  if (answers.b && !isFailed(answers.b)) {
    played.push({ answer: answers.b, beat: beatAt(answers.b.clock[now.rule], share), mark: 'mark-b' });
  }
  const windings = (axis: 0 | 1): Windings | undefined => windingsOf(core, played[0], axis);
  const [first, second] = [windings(0), windings(1)];
  const place = (axis: 0 | 1): number => {
    const places = axis === 0 ? a.x : a.y;
    return beat > 0 ? (places[beat - 1] ?? 0) : startOf({ answer: a, beat: 0, mark: 'mark-a' }, axis);
  };
  return (
    <div
      class="lab-steps"
      onKeyDown={(event) => {
        if (event.target instanceof HTMLInputElement && event.target.type === 'number') return;
        if (event.key === '.') goTo(beat + 1);
        else if (event.key === ',') goTo(beat - 1);
        else return;
        event.preventDefault();
      }}
    >
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
        <JudgementLine played={played} beat={beat} quiet={playing} />
        <Grid
          played={played}
          start={[move.from.x, move.from.y]}
          end={[move.to.x, move.to.y]}
          share={share}
          {...(move.arc ? { centre: [0, 0] as const, onStart: (to: [number, number]) => change({ radius: bound(Math.abs(to[0]), 1), end: now.end }) } : {})}
          onEnd={([x, y]) => {
            if (move.arc) change({ end: [x, y] });
            else if (x !== 0 || y !== 0) change({ to: [bound(x, -farthest), bound(y, -farthest)] });
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
            <NumberField label={say('radius')} unit={say('steps')} value={now.radius} step={1} from={1} to={farthest} onChange={(radius) => change({ radius: Math.round(radius) })} />
          </>
        ) : (
          <div class="lab-pair">
            {([0, 1] as const).map((axis) => (
              <NumberField
                key={axis}
                label={`${say('end')} ${axis === 0 ? 'X' : 'Y'}`}
                value={now.to[axis]}
                step={1}
                from={-farthest}
                to={farthest}
                onChange={(value) => change({ to: axis === 0 ? [Math.round(value), now.to[1]] : [now.to[0], Math.round(value)] })}
              />
            ))}
          </div>
        )}
        <MethodChoice label={`A · ${say('method')}`} value={now.a} shape={now.shape} onChange={(code) => code !== 'none' && change({ a: code })} />
        <MethodChoice label={`B · ${say('beside')}`} value={now.b} shape={now.shape} none onChange={(b) => change({ b })} />
        <Select label={say('duration')} value={now.rule} options={ruleNames.map((value) => ({ value, words: ruleWords(value) }))} onChange={(rule) => change({ rule })} />
        <dl class="lab-figures">
          {played.map(({ answer, mark }) => (
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
          {first && <MotorView axis="X" windings={first} place={place(0)} fullSteps={Number(now.rotor)} />}
          {second && <MotorView axis="Y" windings={second} place={place(1)} fullSteps={Number(now.rotor)} />}
        </div>
      </section>
      <section class="panel">
        <h2>{say('beatsTitle')}</h2>
        <Lesson>{say('beatsLesson')}</Lesson>
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

function windingsOf(core: LabCore, played: Played | undefined, axis: 0 | 1): Windings | undefined {
  const { drive, rotor } = view.value;
  const places = axis === 0 ? played?.answer.x : played?.answer.y;
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
  none?: boolean;
  onChange: (code: MethodCode | 'none') => void;
}
function MethodChoice({ label, value, shape, none = false, onChange }: MethodChoiceProps): JSX.Element {
  const codes: (MethodCode | 'none')[] = [...(none ? (['none'] as const) : []), ...methodsFor(shape)];
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
    .map(([name, cells]) => (name === 'judge' ? (cells[beat - 1] ?? '') : `${name} = ${cells[beat - 1] ?? ''}`))
    .join(', ')
    .replace('>=', ' ≥ ')
    .replace('<', ' < ')
    .replaceAll('-', '−');
  return (
    <p class="lab-judgement" aria-live={quiet ? 'off' : 'polite'}>
      <span>{say('pulse')} <b>{beat}</b></span>
      <span class="lab-judged">{judged}</span>
      <span>→ <b class="lab-feed">{feedText(answer, beat - 1)}</b></span>
      <span>({answer.x[beat - 1]}, {answer.y[beat - 1]})</span>
      <span>{say('error')} <b>{(answer.deviation[beat - 1] ?? 0).toFixed(3)}</b> {say('steps')}</span>
    </p>
  );
}
