// The state in words, what to do next, and who has the motion.
import { computed } from '@preact/signals';
import { say } from '../core/language';
import { attempt } from '../core/notices';
import { confirm } from '../core/question';
import { canHome } from '../machine/abilities';
import { adviceWords } from '../machine/advice';
import { connection, status } from '../machine/connection';
import { ownership, takeOwnership } from '../machine/owner';
import { nameInWords } from '../machine/page_name';
import { shown } from '../machine/programs';
import { stateWords, type Tone } from '../machine/words';
import { Button } from './button';
import { Icon, type IconName } from './icon';
import { Reported } from './reported';

const icons: Record<Tone, IconName> = { calm: 'calm', go: 'run', wait: 'hold', bad: 'bad' };

const words = computed(() => {
  const now = status.value;
  if (now === null) return null;
  return stateWords({ status: now, program: shown.value === null ? 'none' : shown.value.state === 'bad' ? 'bad' : 'open', canHome: canHome.value, broken: adviceWords.value });
});

export function StateBanner() {
  const now = words.value;
  if (now === null) return <div class="state calm">{say('connection.connecting')}</div>;
  if (connection.value === 'lost') {
    return (
      <div class="state calm">
        <Icon name="lost" />
        <strong class="state-title dim" role="status" data-testid="state">
          {say('connection.lost.state', { state: now.title })}
        </strong>
      </div>
    );
  }
  return (
    <div class={`state ${now.tone}`}>
      <Icon name={icons[now.tone]} />
      <div class="state-words">
        <strong class="state-title" role="status" data-testid="state">
          {now.title}
        </strong>
        <span class="state-next">{now.next}</span>
      </div>
    </div>
  );
}

const nameOfOwner = (): string => {
  const owner = status.value?.owner;
  return owner?.kind === 'sender' ? say('owner.sender') : nameInWords(owner?.name ?? '');
};

async function takeOver(): Promise<void> {
  const yes = await confirm({
    title: say('owner.take.ask', { name: nameOfOwner() }),
    facts: [say('owner.take.what')],
    yes: say('owner.take'),
    kind: 'plain',
  });
  if (yes) await attempt(takeOwnership);
}

export function OwnerBanner() {
  if (ownership.value !== 'other') return null;
  return (
    <div class="owner" role="status">
      <span>{say('owner.other', { name: nameOfOwner() })}</span>
      <Button onClick={takeOver}>{say('owner.take')}</Button>
    </div>
  );
}

// A machine file that does not suit the board, or a spindle whose drive has failed. An alarm and a fault are told by the state.
export function FileBanner() {
  const now = status.value;
  if (now === null || now.trouble === '') return null;
  const code = now.trouble_sentence?.code ?? '';
  if (code !== 'grbl.other-machine' && !code.startsWith('spindle.')) return null;
  return (
    <div class="owner" role="alert">
      <Reported words={now.trouble} sentence={now.trouble_sentence} />
    </div>
  );
}

// What has happened and is not on the disk yet.
export function DiskBanner() {
  const unkept = status.value?.unkept ?? '';
  if (unkept === '') return null;
  return (
    <div class="owner" role="alert">
      <div>
        {unkept.split('; ').map((words, i) => (
          <p key={words}>
            <Reported words={words} sentence={status.value?.unkept_sentences?.[i] ?? null} />
          </p>
        ))}
        <p class="dim">{say('disk.next')}</p>
      </div>
    </div>
  );
}
