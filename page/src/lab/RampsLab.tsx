// When a motor steps: the methods of ramps side by side, against the ideal line.
import type { JSX } from 'preact';
import { useMemo } from 'preact/hooks';
import { Chart, type ChartLine } from './Chart';
import { type Answer, isFailed, type LabCore, type Ramp, type RampRequest } from './core';
import { Lesson, Refused, short, Tick } from './shared';
import { change, view } from './state';
import { ViewNumber } from './ViewNumber';
import { refusal, say } from './words';

interface Shown {
  key: 'exact' | 'recursive' | 'tabled' | 'curved';
  mark: string;
  answer: Answer<Ramp>;
}

export function RampsLab({ core }: { core: LabCore }): JSX.Element {
  const now = view.value;
  const base: RampRequest = {
    method: 'exact', clock: now.clock, stepsPerTurn: now.turn, acceleration: now.accel, steps: now.steps,
    wholeMove: now.move, wholeTicks: true, rate: now.rate, start: now.start, jerk: 0, tableSize: now.table,
  };
  const shown = useMemo((): Shown[] => {
    const all: Shown[] = [];
    if (now.exact) all.push({ key: 'exact', mark: 'mark-a', answer: core.ramp(base) });
    if (now.recursive) all.push({ key: 'recursive', mark: 'mark-b', answer: core.ramp({ ...base, method: 'recursive', wholeTicks: false }) });
    if (now.tabled) all.push({ key: 'tabled', mark: 'mark-c', answer: core.ramp({ ...base, method: 'table' }) });
    if (now.curved && now.move && now.jerk > 0) {
      all.push({ key: 'curved', mark: 'mark-d', answer: core.ramp({ ...base, jerk: now.jerk }) });
    }
    return all;
  }, [core, JSON.stringify(base), now.exact, now.recursive, now.tabled, now.curved, now.jerk]);
  const good = shown.flatMap((one) => (isFailed(one.answer) ? [] : [{ ...one, answer: one.answer }]));
  const first = good[0]?.answer;
  const rates: ChartLine[] = good.map(({ key, mark, answer }) => ({ name: say(key), mark, ...rateLine(answer, now.clock) }));
  if (first) {
    rates.push({ name: say('idealLine'), mark: 'mark-ideal', x: first.ideal_time_s.map((time) => time * 1000), y: first.ideal_rate_hz });
  }
  return (
    <div class="lab-study">
      <div class="panel lab-controls">
        <Lesson>{say('rampsLesson')}</Lesson>
        <div class="lab-ticks-row">
          {(['exact', 'recursive', 'tabled', 'curved'] as const).map((key, i) => (
            <Tick key={key} label={say(key)} mark={`mark-${'abcd'[i]}`} checked={now[key]} onChange={(checked) => change({ [key]: checked })} />
          ))}
        </div>
        <Tick label={say('toRestAgain')} checked={now.move} onChange={(checked) => change({ move: checked })} />
        <div class="lab-pair">
          <ViewNumber name="accel" label={say('acceleration')} unit="rad/s²" step={5} />
          <ViewNumber name="rate" label={say('rate')} unit={say('perSecond')} step={50} />
          <ViewNumber name="start" label={say('startRate')} unit={say('perSecond')} step={10} />
          <ViewNumber name="steps" label={say('count')} unit="" step={10} />
          <ViewNumber name="turn" label={say('stepsATurn')} unit="" step={4} />
          <ViewNumber name="clock" label={say('timerClock')} unit="Hz" step={10_000} />
          <ViewNumber name="table" label={say('tableSize')} unit="" step={64} />
          <ViewNumber name="jerk" label={say('jerk')} unit="rad/s³" step={100} />
        </div>
      </div>
      <div class="panel lab-charts">
        {shown.map(({ key, answer }) => isFailed(answer) && <Refused key={key} words={`${say(key)}: ${refusal(answer.error)}`} />)}
        {good.length > 0 && (
          <>
            <Chart title={say('rateOverTime')} xTitle={`${say('time')}, ms`} yTitle={say('perSecond')} lines={rates} from={0} height={300} />
            <Lesson>{say('intervalsLesson')}</Lesson>
            <Chart
              title={say('timerValues')} xTitle={say('step')} yTitle={say('ticks')} logarithmic least={1}
              lines={good.map(({ key, mark, answer }) => ({ name: say(key), mark, x: answer.ticks.map((_, n) => n), y: answer.ticks }))}
            />
            <Chart
              title={say('errorOfInterval')} xTitle={say('step')} yTitle={say('ticks')} logarithmic least={0.01}
              lines={good.filter(({ key }) => key !== 'curved').map(({ key, mark, answer }) => ({
                name: say(key), mark, x: answer.error_ticks.map((_, n) => n), y: answer.error_ticks, dots: answer.whole_ticks,
              }))}
            />
            <div class="lab-table-frame" tabIndex={0} role="region" aria-label={say('errorOfInterval')}>
              <table>
                <thead>
                  <tr>
                    <th>{say('method')}</th>
                    <th>{say('firstInterval')}</th>
                    <th>{say('largestError')}</th>
                    <th>{say('largestShare')}</th>
                    <th>{say('shortest')}</th>
                    <th>{say('wholeTime')}</th>
                  </tr>
                </thead>
                <tbody>
                  {good.map(({ key, mark, answer }) => {
                    const sizes = answer.error_ticks.map(Math.abs);
                    const shares = sizes.map((size, n) => size / ((answer.ticks[n] ?? 1) - (answer.error_ticks[n] ?? 0)));
                    return (
                      <tr key={key}>
                        <th scope="row"><i class={`lab-mark ${mark}`} aria-hidden="true" /> {say(key)}</th>
                        <td>{short(answer.ticks[0] ?? 0, 5)}</td>
                        <td>{key === 'curved' ? '–' : short(most(sizes))}</td>
                        <td>{key === 'curved' ? '–' : `${short(100 * most(shares))} %`}</td>
                        <td>{short(least(answer.ticks), 4)}</td>
                        <td>{short(1000 * (answer.end_s.at(-1) ?? 0), 5)} ms</td>
                      </tr>
                    );
                  })}
                </tbody>
              </table>
            </div>
          </>
        )}
      </div>
    </div>
  );
}

const most = (values: readonly number[]): number => values.reduce((a, b) => Math.max(a, b), 0);
const least = (values: readonly number[]): number => values.reduce((a, b) => Math.min(a, b), Infinity);

// The mean rate of each interval: of few as a stair, of many at their middles.
function rateLine(answer: Ramp, clock: number): { x: number[]; y: number[] } {
  const stair = answer.ticks.length <= 120;
  const x: number[] = [];
  const y: number[] = [];
  answer.ticks.forEach((ticks, n) => {
    const end = answer.end_s[n] ?? 0;
    const begin = n === 0 ? 0 : (answer.end_s[n - 1] ?? 0);
    const rate = clock / ticks;
    if (stair) x.push(begin * 1000, end * 1000), y.push(rate, rate);
    else x.push(((begin + end) / 2) * 1000), y.push(rate);
  });
  return { x, y };
}
