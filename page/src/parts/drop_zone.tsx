// Where files are dropped or chosen.
import { useRef, useState } from 'preact/hooks';
import { say } from '../core/language';
import { isLive } from '../machine/connection';
import { Button } from './button';
import { Icon } from './icon';

interface DropZoneProps {
  words: string;
  accept?: string; // what the file dialog offers
  take: (files: readonly File[]) => Promise<void>;
}

export function DropZone({ words, accept, take }: DropZoneProps) {
  const input = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);
  return (
    <div
      class={`drop ${over ? 'over' : ''}`}
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
      <span>{words}</span>
      <Button kind="accent" why={isLive.value ? '' : say('why.lost')} onClick={() => input.current?.click()}>
        {say('files.choose')}
      </Button>
      <input
        ref={input}
        type="file"
        hidden
        multiple
        accept={accept}
        aria-label={say('files.choose')}
        onChange={(event) => {
          const field = event.currentTarget;
          void take([...(field.files ?? [])]).then(() => (field.value = ''));
        }}
      />
    </div>
  );
}
