// Small parts that all pages of the lab share.
import type { ComponentChildren, JSX, RefObject } from 'preact';
import { useEffect, useId, useLayoutEffect, useRef, useState } from 'preact/hooks';

// In units of a sixteenth of the page's font size, so that drawings grow with the words, up to 4K.
export interface Size {
  width: number;
  height: number;
  unit: number; // CSS pixels
}
export const noSize: Size = { width: 0, height: 0, unit: 1 };

// The size of an element, kept up to date.
export function useSize<E extends Element>(): [RefObject<E | null>, Size] {
  const element = useRef<E | null>(null);
  const [size, setSize] = useState<Size>(noSize);
  useLayoutEffect(() => {
    const here = element.current;
    if (!here) return;
    const measure = (): void => {
      const box = here.getBoundingClientRect();
      const unit = parseFloat(getComputedStyle(document.documentElement).fontSize) / 16 || 1;
      setSize({ width: box.width / unit, height: box.height / unit, unit });
    };
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(here);
    return () => observer.disconnect();
  }, []);
  return [element, size];
}

interface NumberFieldProps {
  label: string;
  unit?: string | undefined;
  value: number;
  step: number;
  from: number;
  to: number;
  onChange: (value: number) => void;
}
// A number is taken as soon as it makes sense; what makes none is marked, and the last good one stays.
export function NumberField({ label, unit, value, step, from, to, onChange }: NumberFieldProps): JSX.Element {
  const [text, setText] = useState(String(value));
  const wrong = !isGood(text, from, to);
  useEffect(() => {
    setText((before) => (isGood(before, from, to) && Number(before) === value ? before : String(value)));
  }, [value, from, to]);
  return (
    <label class="lab-field">
      <span>{label}</span>
      <span class="lab-input">
        <input
          type="number"
          inputMode="decimal"
          value={text}
          step={step}
          min={from}
          max={to}
          aria-invalid={wrong}
          onInput={(event) => {
            const typed = event.currentTarget.value;
            setText(typed);
            if (isGood(typed, from, to)) onChange(Number(typed));
          }}
          onBlur={() => setText(String(value))}
        />
        {unit !== undefined && <span class="lab-unit">{unit}</span>}
      </span>
    </label>
  );
}
function isGood(text: string, from: number, to: number): boolean {
  const value = Number(text);
  return text.trim() !== '' && Number.isFinite(value) && value >= from && value <= to;
}

interface ChoiceProps<T extends string> {
  label: string;
  value: T;
  options: readonly { value: T; words: string }[];
  onChange: (value: T) => void;
}
export function Select<T extends string>({ label, value, options, onChange }: ChoiceProps<T>): JSX.Element {
  return (
    <label class="lab-field">
      <span>{label}</span>
      <select value={value} onChange={(event) => onChange(event.currentTarget.value as T)}>
        {options.map((one) => (
          <option key={one.value} value={one.value}>
            {one.words}
          </option>
        ))}
      </select>
    </label>
  );
}

// A choice of two to four, all of which are seen.
export function Segments<T extends string>({ label, value, options, onChange }: ChoiceProps<T>): JSX.Element {
  const name = useId();
  return (
    <fieldset class="lab-segments">
      <legend>{label}</legend>
      <div>
        {options.map((one) => (
          <label key={one.value}>
            <input type="radio" name={name} checked={one.value === value} onChange={() => onChange(one.value)} />
            <span>{one.words}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

interface TickProps {
  label: string;
  checked: boolean;
  mark?: string;
  onChange: (checked: boolean) => void;
}
export function Tick({ label, checked, mark, onChange }: TickProps): JSX.Element {
  return (
    <label class="lab-tick">
      <input type="checkbox" checked={checked} onChange={(event) => onChange(event.currentTarget.checked)} />
      {mark !== undefined && <i class={`lab-mark ${mark}`} aria-hidden="true" />}
      <span>{label}</span>
    </label>
  );
}

export function Lesson({ children }: { children: ComponentChildren }): JSX.Element {
  return <p class="lab-lesson">{children}</p>;
}
export function Refused({ words }: { words: string }): JSX.Element {
  return (
    <p class="lab-refused" role="status">
      {words}
    </p>
  );
}
// A figure with its name: <Figure name="Largest error" value="0.452" unit="steps" />
export function Figure({ name, value, unit, mark }: { name: string; value: string; unit?: string; mark?: string }): JSX.Element {
  return (
    <div class="lab-figure">
      <dt>
        {mark !== undefined && <i class={`lab-mark ${mark}`} aria-hidden="true" />}
        {name}
      </dt>
      <dd>
        {value}
        {unit !== undefined && <small> {unit}</small>}
      </dd>
    </div>
  );
}

// Three digits that mean something: 0.452, 12.3, 1234.
export function short(value: number, digits = 3): string {
  if (value === 0 || Math.abs(value) < 1e-12) return '0';
  const text = value.toPrecision(digits);
  return text.includes('e') ? String(Number(value.toPrecision(digits))) : text;
}
