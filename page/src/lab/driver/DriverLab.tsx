// The stage that switches a winding: how its current rises, and what the Darlington's base resistor and heat are.
import type { JSX } from 'preact';
import { useMemo } from 'preact/hooks';
import { Chart } from '../Chart';
import { type Driver, type DriverRequest, isFailed, type LabCore, type Motor, stageNames } from '../core';
import { Figure, Lesson, Refused, short } from '../shared';
import { change, view } from '../state';
import type { LabView } from '../view';
import { ViewNumber } from '../ViewNumber';
import { refusal, say } from '../words';

const marks = { plain: 'mark-a', series: 'mark-b', chopper: 'mark-c' } as const;
// Neither has a part in a current or in pull-out torque.
const anyInertia = 1e-5; // kg·m²

function motorOf(now: LabView): Motor {
  return {
    stepsPerTurn: 200, rotorInertia: anyInertia, holdingTorque: now.dhold, current: now.damps, resistance: now.dohms,
    inductance: now.dmh / 1000, supply: now.dvolts, resistive: true, loadInertia: 0, friction: 0,
  };
}

export function DriverLab({ core }: { core: LabCore }): JSX.Element {
  const now = view.value;
  const motor = motorOf(now);
  const request: DriverRequest = {
    drop: now.dsat, raised: now.raised, series: now.series, ripple: now.ripple, rate: now.drate, gain: now.gain,
    baseEmitter: now.vbe, logic: now.logic, reserve: now.reserve, base: now.base,
  };
  const answer = useMemo(() => core.driver(motor, request), [core, JSON.stringify([motor, request])]);
  const fitting = (now.raised - now.dsat) / now.damps - now.dohms;
  return (
    <div class="lab-study">
      <div class="panel lab-controls">
        <Lesson>{say('driverLesson')}</Lesson>
        <div class="lab-pair">
          <ViewNumber name="damps" label={say('current')} unit="A" step={0.1} />
          <ViewNumber name="dohms" label={say('resistance')} unit="Ω" step={0.1} />
          <ViewNumber name="dmh" label={say('inductance')} unit="mH" step={1} />
          <ViewNumber name="dhold" label={say('holdingTorque')} unit="N·m" step={0.05} />
          <ViewNumber name="dvolts" label={say('supply')} unit="V" step={0.1} />
          <ViewNumber name="dsat" label={say('saturation')} unit="V" step={0.1} />
          <ViewNumber name="raised" label={say('raisedSupply')} unit="V" step={1} />
          <ViewNumber name="series" label={say('seriesResistor')} unit="Ω" step={1} />
          <ViewNumber name="ripple" label={say('chopperBand')} unit="" step={0.01} />
          <ViewNumber name="drate" label={say('rate')} unit={say('perSecond')} step={50} />
        </div>
        <button type="button" class="button" disabled={!(fitting >= 0)} onClick={() => change({ series: Number(fitting.toPrecision(4)) })}>
          {say('fitSeries')}
        </button>
        <Lesson>{say('stagesLesson')}</Lesson>
      </div>
      <div class="panel lab-charts">
        {isFailed(answer) ? (
          <Refused words={refusal(answer.error)} />
        ) : (
          <>
            <Chart
              title={say('currentOverTime')} xTitle={`${say('time')}, ms`} yTitle="A" height={320} from={0}
              lines={[
                ...stageNames.map((name) => ({ name: say(`stage_${name}`), mark: marks[name], x: answer[name].time_s.map(ms), y: answer[name].current_a })),
                { name: say('current'), mark: 'mark-ideal', x: [0, ms(answer.plain.time_s.at(-1) ?? 0)], y: [now.damps, now.damps] },
              ]}
              marks={[{ x: ms(2 / now.drate), words: say('switchedOff') }]}
            />
            <div class="lab-table-frame" tabIndex={0} role="region" aria-label={say('stagesTable')}>
              <table class="lab-comparison lab-stages">
                <thead>
                  <tr>
                    <th>{say('stageTitle')}</th>
                    <th>τ, ms</th>
                    <th>{say('riseTo90')}, ms</th>
                    <th>{say('mostCurrent')}, A</th>
                    <th>{say('windingHeat')}, W</th>
                    <th>{say('resistorHeat')}, W</th>
                    <th>{say('transistorHeat')}, W</th>
                  </tr>
                </thead>
                <tbody>
                  {stageNames.map((name) => {
                    const stage = answer[name];
                    return (
                      <tr key={name} data-stage={name}>
                        <th scope="row"><i class={`lab-mark ${marks[name]}`} aria-hidden="true" /> {say(`stage_${name}`)}</th>
                        <td>{short(ms(stage.tau_s))}</td>
                        <td>{stage.rise_s === null ? '–' : short(ms(stage.rise_s))}</td>
                        <td>{short(stage.most_a)}</td>
                        <td>{short(stage.winding_w)}</td>
                        <td>{short(stage.series_w)}</td>
                        <td>{short(stage.transistor_w)}</td>
                      </tr>
                    );
                  })}
                </tbody>
              </table>
            </div>
            <Chart
              title={say('torqueOverRate')} xTitle={`${say('rate')}, ${say('fullStepsPerSecond')}`} yTitle="N·m" from={0} height={280}
              lines={stageNames.map((name) => ({ name: say(`stage_${name}`), mark: marks[name], x: answer[name].rate_hz, y: answer[name].pull_out_nm }))}
            />
          </>
        )}
        <h2>{say('baseTitle')}</h2>
        <Lesson>{say('baseLesson')}</Lesson>
        <div class="lab-pair lab-base">
          <ViewNumber name="gain" label={say('gainTitle')} unit="" step={50} />
          <ViewNumber name="logic" label={say('logicVolts')} unit="V" step={0.1} />
          <ViewNumber name="vbe" label={say('baseEmitter')} unit="V" step={0.1} />
          <ViewNumber name="reserve" label={say('reserveTitle')} unit="" step={0.05} />
          <ViewNumber name="base" label={say('baseResistor')} unit="Ω" step={10} />
        </div>
        {!isFailed(answer) && <BaseSums base={answer.base} />}
      </div>
    </div>
  );
}

function BaseSums({ base }: { base: Driver['base'] }): JSX.Element {
  const now = view.value;
  return (
    <>
      <ol class="lab-sums">
        <li>I<sub>B</sub> ≥ I<sub>C</sub>/h<sub>FE</sub> = {now.damps} A / {now.gain} = <b>{short(ma(base.needed_a))} mA</b></li>
        <li>{say('withReserve', { percent: Number((100 * now.reserve).toPrecision(4)) })}: <b>{short(ma(base.wanted_a))} mA</b></li>
        <li>R<sub>B</sub> ≤ ({now.logic} V − {now.vbe} V) / {short(ma(base.wanted_a))} mA = <b data-largest>{short(base.largest_ohm, 4)} Ω</b></li>
        <li>
          {now.base} Ω: I<sub>B</sub> = <b>{short(ma(base.given_a))} mA</b>,{' '}
          <span data-overdrive>{say(base.given_a >= base.wanted_a ? 'baseAmple' : 'baseTooLittle', { times: short(base.overdrive) })}</span>
        </li>
      </ol>
      <dl class="lab-figures">
        <Figure name={say('heatWhileOn')} value={short(base.heat_w)} unit="W" />
        <Figure name={say('warmerBy')} value={short(base.warmer_k)} unit="K" />
      </dl>
    </>
  );
}

const ms = (seconds: number): number => seconds * 1000;
const ma = (amperes: number): number => amperes * 1000;
