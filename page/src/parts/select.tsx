// A list to choose from.
export type Choices = readonly (readonly [value: string, words: string])[];

interface Props {
  value: string;
  all: Choices;
  none?: string | null; // the words of an empty value; null: it is listed only while nothing is chosen
  set: (to: string) => unknown;
  'aria-label'?: string;
  'aria-invalid'?: boolean;
  'data-path'?: string;
}

// A value that is none of them, e.g. one written by hand, is listed too.
export function Select({ value, all, none = null, set, ...others }: Props) {
  const known = value === '' || all.some(([one]) => one === value) ? all : [...all, [value, value] as const];
  return (
    <select {...others} value={value} onChange={(event) => set(event.currentTarget.value)}>
      {(none !== null || value === '') && <option value="">{none ?? ''}</option>}
      {known.map(([one, words]) => (
        <option key={one} value={one}>
          {words}
        </option>
      ))}
    </select>
  );
}

export function SelectField({ title, class: more = '', ...select }: Props & { title: string; class?: string }) {
  return (
    <label class={`form-field ${more}`}>
      <span class="dim">{title}</span>
      <Select {...select} />
    </label>
  );
}
