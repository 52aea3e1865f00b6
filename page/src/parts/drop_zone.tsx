// Where files are dropped or chosen.
import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import { Button } from './button';
import { FileChoice } from './file_choice';
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
      <FileChoice label={choose} accept={accept} multiple take={take}>
        {(open) => (
          <Button kind="accent" why={why} onClick={open}>
            {choose}
          </Button>
        )}
      </FileChoice>
    </div>
  );
}
