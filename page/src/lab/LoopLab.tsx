// A motor with an encoder and a controller: the response to a jump, while the gains are turned.
import type { JSX } from 'preact';
import { useMemo, useState } from 'preact/hooks';
import { Chart } from './Chart';
import { type Gains, isFailed, type LabCore, type LoopRequest } from './core';
import { MotorFields, motorOf } from './motor_fields';
import { Figure, Lesson, Refused, Segments, short } from './shared';
import { change, view } from './state';
import { ViewNumber } from './ViewNumber';
import { refusal, say } from './words';

const period = 1e-4; // s, of the control

export function LoopLab({ core }: { core: LabCore }): JSX.Element {
  const now = view.value;
  const motor = motorOf(now, 'drag');
  const places = now.of === 'position';
  const request: LoopRequest = {
    of: now.of, to: places ? (now.jump * Math.PI) / 180 : now.jump, period,
    gains: { kp: now.kp, ki: now.ki, kd: now.kd }, inner: { kp: now.ikp, ki: now.iki },
    load: now.load, loadAt: now.loadat, time: now.time,
  };
  const answer = useMemo(() => core.loop(motor, request), [core, JSON.stringify([motor, request])]);
  const [swing, setSwing] = useState<string | undefined>();
  const unit = places ? '°' : 'rad/s';
  const scale = places ? 180 / Math.PI : 1;

  const take = (rule: 'p' | 'pi' | 'pid'): void => {
    const found = core.ultimate(motor, request);
    if (isFailed(found)) {
      setSwing(refusal(found.error));
      return;
    }
    setSwing(say('swingsAt', { gain: short(found.gain), ms: short(found.period_s * 1000) }));
    const gains: Gains = found[rule];
    change({ kp: gains.kp, ki: gains.ki, kd: gains.kd });
  };
  const switchTo = (of: 'speed' | 'position'): void => {
    setSwing(undefined);
    change(of === 'position' ? { of, jump: 90, kp: 200, ki: 0, kd: 0 } : { of, jump: 30, kp: 0.02, ki: 2, kd: 0 });
  };
  const tops = places ? { kp: 3000, ki: 1e6, kd: 1 } : { kp: 0.2, ki: 100, kd: 1e-4 };
  return (
    <div class="lab-study">
      <div class="panel lab-controls">
        <Lesson>{say('loopLesson')}</Lesson>
        <Segments
          label={say('controlled')} value={now.of} onChange={switchTo}
          options={[{ value: 'speed', words: say('speed') }, { value: 'position', words: say('place') }]}
        />
        {(['kp', 'ki', 'kd'] as const).map((name) => (
          <Gain key={name} name={name} value={now[name]} top={tops[name]} onChange={(value) => change({ [name]: value })} />
        ))}
        <div class="lab-buttons" role="group" aria-label={say('byTheRule')}>
          <span>{say('byTheRule')}</span>
          {(['p', 'pi', 'pid'] as const).map((rule) => (
            <button key={rule} type="button" class="button" onClick={() => take(rule)}>{rule.toUpperCase()}</button>
          ))}
        </div>
        {swing !== undefined && <p class="lab-lesson" role="status">{swing}</p>}
        <div class="lab-pair">
          <ViewNumber name="jump" label={say('jump')} unit={unit} step={1} />
          <ViewNumber name="time" label={say('time')} unit="s" step={0.01} />
          <ViewNumber name="load" label={say('loadTorque')} unit="N·m" step={0.01} />
          <ViewNumber name="loadat" label={say('loadAt')} unit="s" step={0.01} />
          {places && <ViewNumber name="ikp" label={say('innerKp')} unit="" step={0.01} />}
          {places && <ViewNumber name="iki" label={say('innerKi')} unit="" step={0.5} />}
        </div>
        <details>
          <summary>{say('theMotor')}</summary>
          <MotorFields friction="drag" />
        </details>
      </div>
      <div class="panel lab-charts">
        {isFailed(answer) ? (
          <Refused words={refusal(answer.error)} />
        ) : (
          <>
            <dl class="lab-figures">
              <Figure name={say('rise')} value={answer.rise_s === null ? '–' : short(answer.rise_s * 1000)} unit="ms" />
              <Figure name={say('overshoot')} value={short(Math.max(0, answer.overshoot) * 100)} unit="%" />
              <Figure name={say('settled')} value={answer.settled_s === null ? '–' : short(answer.settled_s * 1000)} unit="ms" />
              <Figure name={say('errorBefore')} value={short(answer.steady_error * scale)} unit={unit} />
              <Figure name={say('swingBefore')} value={short(answer.swing * scale)} unit={unit} />
            </dl>
            <Chart
              title={say('response')} xTitle={`${say('time')}, ms`} yTitle={unit} height={320} from={0}
              lines={[
                { name: say('counted'), mark: 'mark-c', x: answer.time_s.map(ms), y: answer.counted.map((value) => value * scale) },
                { name: say('trueValue'), mark: 'mark-a', x: answer.time_s.map(ms), y: answer.is.map((value) => value * scale) },
                { name: say('wanted'), mark: 'mark-ideal', x: [0, ms(answer.time_s.at(-1) ?? 0)], y: [answer.wanted * scale, answer.wanted * scale] },
              ]}
              marks={now.load > 0 && now.loadat < now.time ? [{ x: ms(now.loadat), words: say('loadComes') }] : []}
            />
            <Chart
              title={say('torqueAsked')} xTitle={`${say('time')}, ms`} yTitle="N·m"
              lines={[
                { name: say('asked'), mark: 'mark-b', x: answer.time_s.map(ms), y: answer.asked_nm },
                { name: say('given'), mark: 'mark-a', x: answer.time_s.map(ms), y: answer.torque_nm },
              ]}
            />
          </>
        )}
      </div>
    </div>
  );
}

const ms = (seconds: number): number => seconds * 1000;

// A gain by a slider over four decades, and by a number. The slider's left end is 0.
function Gain({ name, value, top, onChange }: { name: string; value: number; top: number; onChange: (value: number) => void }): JSX.Element {
  const decades = 4;
  const steps = 400;
  const position = value <= 0 ? 0 : Math.max(1, steps + (Math.log10(value / top) * steps) / decades);
  return (
    <div class="lab-gain">
      <label>
        <span>{name}</span>
        <input
          type="range" min={0} max={steps} step={1} value={position}
          aria-valuetext={short(value)}
          onInput={(event) => {
            const at = Number(event.currentTarget.value);
            onChange(at === 0 ? 0 : Number((top * 10 ** (((at - steps) * decades) / steps)).toPrecision(3)));
          }}
        />
      </label>
      <input
        type="number" value={Number(value.toPrecision(4))} min={0} step="any" aria-label={name}
        onChange={(event) => {
          const typed = Number(event.currentTarget.value);
          if (Number.isFinite(typed) && typed >= 0) onChange(typed);
        }}
      />
    </div>
  );
}
