// Where files are dropped or chosen.
import type { ComponentChildren } from 'preact';
import { useRef, useState } from 'preact/hooks';
import { Button } from './button';
import { Icon } from './icon';

interface DropZoneProps {
  choose: string; // the words of the button
  why?: string; // why no file can be chosen now
  accept?: string; // what the file dialog offers
  classes?: string;
  children: ComponentChildren; // what may be dropped
  take: (files: readonly File[]) => Promise<void>;
}

export function DropZone({ choose, why = '', accept, classes, children, take }: DropZoneProps) {
  const input = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);
  return (
    <div
      class={`drop ${classes ?? ''} ${over ? 'over' : ''}`}
      onDragOver={(event) => {
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={(event) => {
        event.preventDefault();
        setOver(false);
        void take([...(event.dataTransfer?.files ?? [])]);
      }}
    >
      <Icon name="upload" />
      <span>{children}</span>
      <Button kind="accent" why={why} onClick={() => input.current?.click()}>
        {choose}
      </Button>
      <input
        ref={input}
        type="file"
        hidden
        multiple
        accept={accept}
        aria-label={choose}
        onChange={(event) => {
          const field = event.currentTarget;
          void take([...(field.files ?? [])]).then(() => (field.value = ''));
        }}
      />
    </div>
  );
}
