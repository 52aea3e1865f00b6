// How much torque is left at each speed: pull-out, pull-in and friction.
import type { JSX } from 'preact';
import { useMemo } from 'preact/hooks';
import { Chart } from './Chart';
import { isFailed, type LabCore } from './core';
import { MotorFields, motorOf } from './motor_fields';
import { Figure, Lesson, Refused, short } from './shared';
import { view } from './state';
import { ViewNumber } from './ViewNumber';
import { refusal, say } from './words';

const rows = 240;

export function TorqueLab({ core }: { core: LabCore }): JSX.Element {
  const now = view.value;
  const motor = motorOf(now, 'friction');
  const answer = useMemo(() => core.torque(motor, now.margin, now.wants, rows), [core, JSON.stringify(motor), now.margin, now.wants]);
  return (
    <div class="lab-study">
      <div class="panel lab-controls">
        <Lesson>{say('torqueLesson')}</Lesson>
        <MotorFields friction="friction" />
        <ViewNumber name="wants" label={say('wantedAcceleration')} unit="rad/s²" step={500} />
        <ViewNumber name="margin" label={say('margin')} step={0.05} />
      </div>
      <div class="panel lab-charts">
        {isFailed(answer) ? (
          <Refused words={refusal(answer.error)} />
        ) : (
          <>
            <dl class="lab-figures">
              <Figure name={say('standstill')} value={short(answer.standstill_torque_nm)} unit="N·m" />
              <Figure name={say('startingRate')} value={short(answer.starting_rate_hz)} unit={say('perSecond')} />
              <Figure
                name={say('fastestRate')}
                value={answer.fastest_rate_hz === null ? '∞' : short(answer.fastest_rate_hz, 4)}
                unit={say('perSecond')}
              />
              <Figure
                name={say('acceleratedRate')}
                value={answer.accelerated_rate_hz === null ? '∞' : short(answer.accelerated_rate_hz, 4)}
                unit={say('perSecond')}
              />
            </dl>
            <Chart
              title={say('torqueOverRate')} xTitle={`${say('rate')}, ${say('fullStepsPerSecond')}`} yTitle="N·m" from={0} height={320}
              lines={[
                { name: say('pullOut'), mark: 'mark-a', x: answer.rate_hz, y: answer.pull_out_nm },
                { name: say('pullIn'), mark: 'mark-b', x: answer.rate_hz, y: answer.pull_in_nm },
                { name: say('neededTorque'), mark: 'mark-d', x: answer.rate_hz, y: answer.needed_nm },
                { name: say('friction'), mark: 'mark-ideal', x: answer.rate_hz, y: answer.friction_nm },
              ]}
              marks={[
                { x: answer.starting_rate_hz, words: say('startingRate') },
                ...(answer.accelerated_rate_hz === null || now.wants === 0 ? [] : [{ x: answer.accelerated_rate_hz, words: say('acceleratedRate') }]),
                ...(answer.fastest_rate_hz === null ? [] : [{ x: answer.fastest_rate_hz, words: say('fastestRate') }]),
              ]}
            />
            <Lesson>{say('leftLesson')}</Lesson>
            <Chart
              title={say('accelerationLeft')} xTitle={`${say('rate')}, ${say('fullStepsPerSecond')}`} yTitle="rad/s²" from={0}
              lines={[{ name: say('accelerationLeft'), mark: 'mark-a', x: answer.rate_hz, y: answer.acceleration_rad_s2 }]}
            />
          </>
        )}
      </div>
    </div>
  );
}
