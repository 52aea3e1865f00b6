// The form of a question that asks for values: each with its unit and its range.
import { say } from '../core/language';
import { answers, faultOf, type AskedField, type Question } from '../core/question';
import { fromMm, lengthUnit, speedUnit, toMm } from '../core/units';
import { Typed } from './typed';
import { Choice } from './view_dialog';

const isScaled = (field: AskedField): boolean => field.measure !== 'plain';
const unitOf = (field: AskedField): string =>
  field.measure === 'length' ? lengthUnit() : field.measure === 'speed' ? speedUnit() : (field.unit ?? '');
const shownAs = (field: AskedField, value: number): string => String(Number((isScaled(field) ? fromMm(value) : value).toFixed(4)));
const set = (name: string, to: number | string | null): void => {
  answers.value = { ...answers.value, [name]: to };
};

export const rangeOf = (field: AskedField): string =>
  say('ask.range', { low: shownAs(field, field.low), high: shownAs(field, field.high) });

function OneValue({ field }: { field: AskedField }) {
  const value = answers.value[field.name];
  const fault = faultOf(field);
  return (
    <label class="form-field">
      <span class="dim">
        {field.title} {unitOf(field)}
      </span>
      <Typed
        inputMode="decimal"
        aria-invalid={fault === 'range'}
        placeholder={field.usual ?? ''}
        value={typeof value === 'number' ? shownAs(field, value) : ''}
        take={(text) => {
          const plain = text.trim().replace(',', '.');
          const typed = Number(plain);
          if (plain === '') set(field.name, null);
          else if (Number.isFinite(typed)) set(field.name, isScaled(field) ? toMm(typed) : typed);
        }}
      />
      {fault !== '' && <span class="dim">{rangeOf(field)}</span>}
    </label>
  );
}

export function AskedValues({ question }: { question: Question }) {
  return (
    <>
      {question.choices?.map((one) => (
        <Choice key={one.name} title={one.title} value={String(answers.value[one.name])} all={one.all} set={(to) => set(one.name, to)} />
      ))}
      {question.fields !== undefined && question.fields.length > 0 && (
        <div class="form-fields">
          {question.fields.map((field) => (
            <OneValue key={field.name} field={field} />
          ))}
        </div>
      )}
    </>
  );
}

// Why the question cannot be answered with yes. Empty: it can.
export function whyNoAnswer(question: Question): string {
  const wrong = question.fields?.find((field) => faultOf(field) !== '');
  return wrong === undefined ? '' : say('ask.wrong', { name: wrong.title, range: rangeOf(wrong) });
}
