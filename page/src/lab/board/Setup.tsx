// The tables of the computer's program: which line is on which pin, and the machine's axes.
import type { JSX } from 'preact';
import { useState } from 'preact/hooks';
import { Lesson, NumberField, Segments, Tick } from '../shared';
import { change, view } from '../state';
import { ViewNumber } from '../ViewNumber';
import { say } from '../words';
import { lineWords } from './PortView';
import { conflictIn, lineNames, lineOn, type LineName, pinsFor, type Wire } from './port';
import { axisNames, inUnit, type Table, type Triple } from './table';

export function PinTable(): JSX.Element {
  const wiring = view.value.lpt;
  const [refused, setRefused] = useState('');
  const set = (line: LineName, wire: Wire): boolean => {
    const wanted = { ...wiring, [line]: wire };
    const conflict = conflictIn(wanted);
    if (conflict !== undefined) {
      const other = lineOn(wiring, wire.pin) ?? conflict[0];
      setRefused(say('pinTaken', { n: wire.pin, one: lineWords(other), other: lineWords(line) }));
      return false;
    }
    setRefused('');
    change({ lpt: wanted, run: false });
    return true;
  };
  return (
    <section class="panel" aria-label={say('pinTable')}>
      <h2>{say('pinTable')}</h2>
      <Lesson>{say('pinTableLesson')}</Lesson>
      <div class="lab-refusal" role="status">{refused !== '' && <p class="lab-refused">{refused}</p>}</div>
      <table class="lab-pins">
        <thead>
          <tr>
            <th scope="col">{say('lineTitle')}</th>
            <th scope="col">{say('pinTitle')}</th>
            <th scope="col">{say('invertedTitle')}</th>
          </tr>
        </thead>
        <tbody>
          {lineNames.map((line) => (
            <tr key={line}>
              <th scope="row">{lineWords(line)}</th>
              <td>
                <select
                  value={wiring[line].pin} aria-label={`${lineWords(line)}, ${say('pinTitle')}`}
                  onChange={(event) => {
                    const select = event.currentTarget;
                    if (!set(line, { ...wiring[line], pin: Number(select.value) })) select.value = String(wiring[line].pin);
                  }}
                >
                  <option value={0}>–</option>
                  {pinsFor(line).map((one) => (
                    <option key={one.pin} value={one.pin}>
                      {`${one.pin} · ${one.inverted ? '¬' : ''}${one.register[0]?.toUpperCase()}${one.bit}`}
                    </option>
                  ))}
                </select>
              </td>
              <td>
                <input
                  type="checkbox" checked={wiring[line].inverted} aria-label={`${lineWords(line)}, ${say('invertedTitle')}`}
                  onChange={(event) => set(line, { ...wiring[line], inverted: event.currentTarget.checked })}
                />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

export const tableOf = (): Table => {
  const { unit, perunit, lengths, origin, flip, zclear, zwork } = view.value;
  return { unit, perunit, lengths, origin, flip, zclear, zwork };
};

export function TableSetup(): JSX.Element {
  const now = view.value;
  const unit = say(now.unit === 'mm' ? 'unitMm' : 'unitInch');
  const row = (name: 'perunit' | 'lengths' | 'origin', words: string, of: string, step: number, from: number, to: number): JSX.Element => (
    <div class="lab-axes" role="group" aria-label={words}>
      {axisNames.map((axis, i) => (
        <NumberField
          key={axis} label={`${words} ${axis}`} unit={of} value={now[name][i] ?? 0} step={step} from={from} to={to}
          onChange={(value) => {
            const values = [...now[name]];
            values[i] = value;
            change({ [name]: values as unknown as Triple });
          }}
        />
      ))}
    </div>
  );
  return (
    <section class="panel lab-controls" aria-label={say('tableSetup')}>
      <h2>{say('tableSetup')}</h2>
      <Lesson>{say('tableLesson')}</Lesson>
      <Segments
        label={say('unitTitle')} value={now.unit} options={[{ value: 'mm', words: say('unitMm') }, { value: 'inch', words: say('unitInch') }]}
        onChange={(to) => change(inUnit(tableOf(), to))}
      />
      {row('perunit', say('stepsPerUnit', { unit }), '', 1, 0.01, 1e6)}
      {row('lengths', say('axisLength'), unit, 1, 0.01, 1e5)}
      {row('origin', say('originTitle'), unit, 1, -1e5, 1e5)}
      <div class="lab-axes">
        {axisNames.map((axis, i) => (
          <Tick key={axis} label={say('invertAxis', { axis })} checked={((now.flip >> i) & 1) === 1} onChange={() => change({ flip: now.flip ^ (1 << i) })} />
        ))}
      </div>
      <div class="lab-pair">
        <ViewNumber name="zclear" label={say('zClear')} unit={unit} step={0.5} />
        <ViewNumber name="zwork" label={say('zWork')} unit={unit} step={0.5} />
      </div>
    </section>
  );
}
