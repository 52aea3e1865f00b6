// What a check has found.
import { reportWords } from '../core/faults';
import { language, say as sayCommon } from '../core/language';
import { durationText } from '../core/time';
import { lengthUnit, placeText, speedText, speedUnit } from '../core/units';
import { Icon, type IconName } from '../parts/icon';
import { verdictIcons, verdictOf, WorstLines } from '../parts/motor_load';
import { ProposalList } from '../parts/proposals';
import { picked } from '../scene/stage';
import type { CheckAnswer, CheckFinding, SpeedBound } from './answer';
import { say } from './words';

const pick = (line: number): void => {
  picked.value = line;
};
const boundWords = ({ limit, axis }: SpeedBound): string => say(`bound_${limit}`, { axis: axis ?? '' });

export function Badges({ answer }: { answer: CheckAnswer }) {
  if (!answer.machine.good) return (
    <ul class="check-badges" data-testid="badges">
      <Badge kind="bad" icon="bad" words={say('machineErrors')} />
    </ul>
  );
  const errors = answer.errors ?? 0;
  const warnings = (answer.findings ?? []).length - errors;
  const { margin } = answer;
  return (
    <ul class="check-badges" data-testid="badges">
      {errors === 0 ? (
        <Badge kind="good" icon="calm" words={say('noErrors')} />
      ) : (
        <Badge kind="bad" icon="bad" words={errors === 1 ? say('oneError') : say('errors', { count: errors })} />
      )}
      {warnings > 0 && <Badge kind="warned" icon="warn" words={warnings === 1 ? say('oneWarning') : say('warnings', { count: warnings })} />}
      {margin === null && <Badge kind="dim" icon="help" words={say('motorsUnknown')} />}
      {margin != null && (
        <Badge
          kind={margin.verdict === 'safe' ? 'good' : margin.verdict === 'lost' ? 'bad' : 'warned'}
          icon={verdictIcons[margin.verdict]}
          words={say(margin.verdict === 'safe' ? 'motorsSafe' : margin.verdict === 'lost' ? 'motorsLost' : 'motorsDoubtful')}
        />
      )}
    </ul>
  );
}
function Badge({ kind, icon, words }: { kind: string; icon: IconName; words: string }) {
  return (
    <li class={`check-badge ${kind}`}>
      <Icon name={icon} /> {words}
    </li>
  );
}

// The line of the program, with a caret under the wrong words. Of a long line only what is around them.
function Caret({ finding }: { finding: CheckFinding }) {
  const around = 60;
  const { text, column, length } = finding;
  if (text === '' || column === 0) return null;
  const begin = Math.min(column - 1, text.length);
  const from = Math.max(0, begin - around);
  const marks = Math.max(1, Math.min(length, text.length - begin, around));
  const shown = (from > 0 ? '…' : '') + text.slice(from, begin + marks + around);
  return (
    <pre class="check-caret">
      {shown}
      {'\n'}
      {' '.repeat(begin - from + (from > 0 ? 1 : 0))}
      <b>{'^'.repeat(marks)}</b>
    </pre>
  );
}

export function Findings({ findings, title, own }: { findings: readonly CheckFinding[]; title: string; own: boolean }) {
  if (findings.length === 0) return null;
  return (
    <section class="panel">
      <h2>{title}</h2>
      <ul class="findings" data-testid="findings">
        {findings.map((one, i) => {
          const inside = (
            <>
              <Icon name={one.severity === 'error' ? 'bad' : 'warn'} />
              <span class="check-finding">
                {one.line > 0 && <b>{one.column > 0 ? say('place', { line: one.line, column: one.column }) : sayCommon('run.line', { line: one.line })}</b>}{' '}
                {reportWords(one.message, one.message_sentence)} <code>[{one.code}]</code>
                <Caret finding={one} />
                {one.expected !== '' && <span class="dim">{say('expected', { what: reportWords(one.expected, one.expected_sentence) })}</span>}
                {one.more_lines.length > 0 && <span class="dim check-more">{say('moreLines', { lines: one.more_lines.slice(0, 8).join(', ') })}</span>}
              </span>
            </>
          );
          return (
            <li key={i} class={one.severity}>
              {own && one.line > 0 ? (
                <button type="button" class="finding" onClick={() => pick(one.line)}>
                  {inside}
                </button>
              ) : (
                <span class="finding">{inside}</span>
              )}
            </li>
          );
        })}
      </ul>
    </section>
  );
}

export function Times({ answer }: { answer: CheckAnswer }) {
  if (answer.time_s === undefined) return null;
  const figures: [string, string][] = [
    [say('time'), `${durationText(answer.time_s)} (${say('cutting')} ${durationText(answer.cutting_s ?? 0)}, ${say('rapid')} ${durationText(answer.rapid_s ?? 0)})`],
    [say('dwell'), durationText(answer.dwell_s ?? 0)],
    [say('toolChanges'), String(answer.tool_changes ?? 0)],
    [say('distance'), `${((answer.feed_mm ?? 0) / 1000).toLocaleString(language.value, { maximumSignificantDigits: 4 })} m`],
  ];
  const stops = answer.waits_first_at ?? [];
  return (
    <section class="panel">
      <table class="facts" data-testid="times">
        <tbody>
          {figures.map(([name, value]) => (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td>{value}</td>
            </tr>
          ))}
          {stops.length > 0 && (
            <tr>
              <th scope="row">{say('stops')}</th>
              <td>{stops.map((one) => `${sayCommon('run.line', { line: one.line })}: ${one.for}${one.tool === undefined ? '' : ` T${one.tool}`}`).join('; ')}</td>
            </tr>
          )}
        </tbody>
      </table>
    </section>
  );
}

export function Axes({ answer }: { answer: CheckAnswer }) {
  if (answer.axes === undefined) return null;
  const unit = (axis: string): string => ('ABC'.includes(axis) ? '°' : lengthUnit());
  const range = (axis: string, [low, high]: [number, number]): string => `${placeText(axis.toLowerCase(), low)} … ${placeText(axis.toLowerCase(), high)} ${unit(axis)}`;
  return (
    <section class="panel">
      <h2>{say('axes')}</h2>
      <div class="check-wide" tabIndex={0} role="region" aria-label={say('axes')}>
        <table class="facts check-table">
          <thead>
            <tr>
              <th scope="col">{say('axis')}</th>
              <th scope="col">{say('range')}</th>
              <th scope="col">{say('travel')}</th>
              <th scope="col">{say('peakSpeed')}</th>
            </tr>
          </thead>
          <tbody>
            {Object.entries(answer.axes).map(([axis, one]) => (
              <tr key={axis}>
                <th scope="row">{axis}</th>
                <td>{one.extents === null ? say('still') : range(axis, one.extents)}</td>
                <td>{range(axis, one.travel)}</td>
                <td>{'ABC'.includes(axis) ? `${Math.round(60 * one.peak_speed)} °/min` : `${speedText(60 * one.peak_speed)} ${speedUnit()}`}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {Object.entries(answer.work ?? {})
        .filter(([, axes]) => Object.keys(axes).length > 0)
        .map(([system, axes]) => (
          <p key={system} class="dim">
            {say('atFeed')} ({system}):{' '}
            {Object.entries(axes)
              .map(([axis, at]) => `${axis} ${range(axis, at)}`)
              .join(', ')}
          </p>
        ))}
    </section>
  );
}

export function Speed({ answer }: { answer: CheckAnswer }) {
  const { speed, time_s } = answer;
  if (speed === undefined || time_s === undefined || time_s <= 0) return null;
  const slow = speed.slowest.filter((one) => one.lost_s >= notableLoss);
  return (
    <section class="panel">
      <h2>{say('speedTitle')}</h2>
      <div class="check-wide" tabIndex={0} role="region" aria-label={say('speedTitle')}>
        <table class="facts check-table" data-testid="bounds">
          <thead>
            <tr>
              <th scope="col">{say('limit')}</th>
              <th scope="col">{say('share')}</th>
              <th scope="col">{say('firstLine')}</th>
            </tr>
          </thead>
          <tbody>
            {speed.bounds.slice(0, mostBounds).map((one) => (
              <tr key={`${one.limit}${one.axis}`}>
                <th scope="row">{boundWords(one)}</th>
                <td>{(one.time_s / time_s).toLocaleString(language.value, { style: 'percent', maximumFractionDigits: 1 })}</td>
                <td>
                  <button type="button" class="check-line" onClick={() => pick(one.first_line)}>
                    {one.first_line}
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {slow.length > 0 && (
        <>
          <h2 class="findings-title">{say('slowest')}</h2>
          <ul class="findings">
            {slow.map((one) => (
              <li key={one.line}>
                <button type="button" class="finding" onClick={() => pick(one.line)}>
                  <span>
                    <b>{sayCommon('run.line', { line: one.line })}</b>{' '}
                    {say('slowLine', {
                      mean: one.unit === 'deg' ? Math.round(60 * one.mean_mm_s) : speedText(60 * one.mean_mm_s),
                      programmed: one.unit === 'deg' ? Math.round(60 * (one.programmed_mm_s ?? 0)) : speedText(60 * (one.programmed_mm_s ?? 0)),
                      unit: one.unit === 'deg' ? '°/min' : speedUnit(),
                      lost: one.lost_s.toLocaleString(language.value, { maximumSignificantDigits: 2 }),
                      bound: boundWords(one),
                    })}
                  </span>
                </button>
              </li>
            ))}
          </ul>
        </>
      )}
    </section>
  );
}
const notableLoss = 0.005; // s
const mostBounds = 6;

export function Motors({ answer }: { answer: CheckAnswer }) {
  const { margin } = answer;
  if (margin == null) return null;
  const worst = margin.worst_lines;
  const first = worst[0];
  const most = first === undefined || first.low_nm <= 0 ? 0 : Math.max(...worst.map((one) => (one.low_nm > 0 ? one.needed_nm / one.low_nm : 0)));
  return (
    <section class="panel" data-testid="motors">
      <h2>{sayCommon('torque.title')}</h2>
      <p class={`verdict ${margin.verdict === 'lost' ? 'bad' : 'good'}`}>
        <Icon name={verdictIcons[margin.verdict]} /> {verdictOf({ verdict: margin.verdict, most })}
      </p>
      <WorstLines worst={worst} pick={pick} />
    </section>
  );
}

export function Remedies({ answer }: { answer: CheckAnswer }) {
  const all = answer.proposals ?? [];
  if (all.length === 0) return null;
  return (
    <section class="panel">
      <h2>{sayCommon('proposals.title')}</h2>
      <ProposalList all={all} />
    </section>
  );
}

