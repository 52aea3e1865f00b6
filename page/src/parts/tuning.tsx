// Limits for the machine's motors, as `passo tune` proposes them, with the curves of their torque.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { confirm } from '../core/question';
import { isLive } from '../machine/connection';
import { draft, setValues, values } from '../machine/machine_file';
import { marginRow, needStudyOptions, tune, tunedCount, tuning, type Tuning as Report } from '../machine/studies';
import { token } from '../machine/token';
import { fromMm, isRotary, lengthUnit } from '../core/units';
import { Button } from './button';
import { Slider } from './slider';

const margin = signal<number | null>(null); // null: the usual one
const limits: readonly ['max_velocity' | 'max_acceleration' | 'max_jerk', string][] = [
  ['max_velocity', '/s'],
  ['max_acceleration', '/s²'],
  ['max_jerk', '/s³'],
];
const short = (value: number): string => (value === 0 ? '–' : String(Number(value.toPrecision(4))));

async function takeOver(report: Report): Promise<void> {
  const yes = await confirm({
    title: say('tune.take.ask'),
    facts: [say('tune.take.facts'), say('file.write.when')],
    rows: report.values.map((one) => [one.key, `${short(one.before)} → ${short(one.after)}`]),
    yes: say('tune.take'),
    kind: 'plain',
  });
  if (yes) await setValues(Object.fromEntries(report.values.map((one) => [one.key, one.after])));
}

function Proposal({ report }: { report: Report }) {
  const secret = token.value === '' ? '' : `&token=${token.value}`;
  return (
    <>
      <p role="status" data-testid="tuned" class={`verdict ${report.verdict === 'safe' ? 'good' : 'bad'}`}>
        {say(`tune.${report.verdict}`)}
      </p>
      <div class="wide-table" tabIndex={0} role="region" aria-label={say('tune.title')}>
        <table>
          <thead>
            <tr>
              <th scope="col">{say('machine.axis')}</th>
              {report.axes.map((one) => (
                <th scope="col" key={one.axis} class="axis-head" data-axis={one.axis.toLowerCase()}>
                  {one.axis}
                </th>
              ))}
              <td />
            </tr>
          </thead>
          <tbody>
            {limits.map(([limit, unit]) => (
              <tr key={limit}>
                <th scope="row">{say(`tune.${limit}`)}</th>
                {report.axes.map((one) => {
                  const set = report.values.find((value) => value.key.startsWith(`axis.${one.axis}.${limit}`));
                  const shown = (value: number): string => short(isRotary(one.axis.toLowerCase()) ? value : fromMm(value));
                  return (
                    <td key={one.axis}>
                      {set !== undefined && <span class="dim">{shown(set.before)} → </span>}
                      <b>{set === undefined ? '–' : shown(set.after)}</b>
                    </td>
                  );
                })}
                <td class="unit">
                  {lengthUnit()}
                  {unit}
                </td>
              </tr>
            ))}
            <tr>
              <th scope="row">{say('tune.bound')}</th>
              {report.axes.map((one) => (
                <td key={one.axis}>{say(`tune.bound.${one.bound}` as 'tune.bound.time')}</td>
              ))}
              <td />
            </tr>
          </tbody>
        </table>
      </div>
      <img class="curves" src={`api/v1/study/picture?tuned=${tunedCount.value}${secret}`} alt={say('tune.picture')} />
      <Button kind="accent" icon="done" why={isLive.value ? '' : say('why.lost')} onClick={() => takeOver(report)}>
        {say('tune.take')} …
      </Button>
    </>
  );
}

export function Tuning() {
  useEffect(() => {
    if (isLive.value) void needStudyOptions();
  }, [isLive.value]);
  const text = draft.value;
  const now = tuning.value;
  const row = marginRow.value;
  if (text === null) return null;
  const share = margin.value ?? row?.default ?? 0;
  const knows = Object.keys(values.value).some((path) => /^axis\.[A-Z]\.torque\./.test(path));
  const why = !isLive.value ? say('why.lost') : !knows ? say('tune.none') : !text.good ? say('file.refused') : now?.state === 'running' ? say('tune.running') : '';
  return (
    <section class="panel tuning" aria-label={say('tune.title')}>
      <h2 class="title">{say('tune.title')}</h2>
      <p class="dim">{say(knows ? 'tune.what' : 'tune.none')}</p>
      {row !== null && (
        <Slider
          class="jog-speed"
          name={say('tune.margin')}
          value={share}
          least={row.minimum}
          step={0.05}
          words={`${Math.round(100 * share)} %`}
          set={(to) => (margin.value = Math.min(row.maximum, to))}
        />
      )}
      <Button icon="lab" why={why} onClick={() => tune(text.text, margin.value === null ? undefined : Number(margin.value.toFixed(2)))}>
        {say('tune.do')}
      </Button>
      {now?.state === 'running' && <p role="status">{say('tune.running')}</p>}
      {now?.state === 'failed' && (
        <pre class="toml failed" lang="en" tabIndex={0}>
          {now.words}
        </pre>
      )}
      {now?.state === 'done' && now.report !== null && <Proposal report={now.report} />}
    </section>
  );
}
