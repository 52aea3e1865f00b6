// Files of this computer. The browser's own field is hidden; `children` draws what opens it.
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';

interface Props {
  label: string;
  accept?: string | undefined;
  multiple?: boolean;
  take: (files: File[]) => Promise<unknown>;
  children: (choose: () => void) => JSX.Element;
}

export function FileChoice({ label, accept, multiple = false, take, children }: Props) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      {children(() => input.current?.click())}
      <input
        ref={input}
        type="file"
        hidden
        multiple={multiple}
        accept={accept}
        aria-label={label}
        onChange={(event) => {
          const field = event.currentTarget;
          // The same file can be chosen again.
          void take([...(field.files ?? [])]).then(() => (field.value = ''));
        }}
      />
    </>
  );
}
