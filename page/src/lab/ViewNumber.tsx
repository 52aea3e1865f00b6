// A number of the view, within the range that the address has for it.
import type { JSX } from 'preact';
import type { NumericField } from './field';
import { NumberField } from './shared';
import { change, view } from './state';
import { fields } from './view';

export type NumberName = { [K in keyof typeof fields]: (typeof fields)[K] extends NumericField ? K : never }[keyof typeof fields];

export function ViewNumber({ name, label, unit, step }: { name: NumberName; label: string; unit?: string; step: number }): JSX.Element {
  const { from, to, whole } = fields[name];
  return (
    <NumberField
      label={label} unit={unit} value={view.value[name]} step={step} from={from} to={to}
      onChange={(value) => change({ [name]: whole ? Math.round(value) : value })}
    />
  );
}
