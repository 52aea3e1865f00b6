// A text field that keeps what a person types until it is done, however often the page is drawn meanwhile. `take` gets it
// then; where it takes nothing, the field shows its value again.
import { useState } from 'preact/hooks';

interface Props {
  value: string;
  take: (typed: string) => unknown;
  inputMode?: 'decimal' | 'numeric';
  placeholder?: string;
  'aria-label'?: string;
  'aria-invalid'?: boolean;
  'data-path'?: string;
}

export function Typed({ value, take, ...others }: Props) {
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <input
      type="text"
      {...others}
      value={typed ?? value}
      onInput={(event) => setTyped(event.currentTarget.value)}
      onChange={(event) => {
        const text = event.currentTarget.value;
        setTyped(null);
        take(text);
      }}
      onBlur={() => setTyped(null)}
    />
  );
}
