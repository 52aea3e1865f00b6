// Colours, units and language; and the shortcuts.
import { signal } from '@preact/signals';
import { language, languages, say, type Key, type Language } from '../core/language';
import { themeChoice } from '../core/theme';
import { units } from '../core/units';
import { status } from '../machine/connection';
import { giveUpOwnership, ownership, takeOwnership } from '../machine/owner';
import { givenName, longestName, ownDevice } from '../machine/page_name';
import { attempt } from '../core/notices';
import { pages } from '../pages/pages';
import { Button } from './button';
import { Dialog } from './dialogs';
import { Typed } from './typed';

export const openDialog = signal<'view' | 'shortcuts' | null>(null);
const close = (): void => void (openDialog.value = null);

interface ChoiceProps<T extends string> {
  title: string;
  value: T;
  all: readonly (readonly [T, string])[];
  set: (value: T) => void;
}
export function Choice<T extends string>({ title, value, all, set }: ChoiceProps<T>) {
  return (
    <fieldset class="choice">
      <legend>{title}</legend>
      <div class="choices">
        {all.map(([one, words]) => (
          <label key={one} class={one === value ? 'chosen' : ''}>
            <input type="radio" name={title} checked={one === value} onChange={() => set(one)} />
            <span lang={one in languages ? one : undefined}>{words}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

async function rename(to: string): Promise<void> {
  givenName.value = to.trim().slice(0, longestName);
  if (ownership.value === 'mine' && status.value?.state === 'Idle') await attempt(takeOwnership);
}

function ViewDialog() {
  return (
    <Dialog title={say('frame.settings')} onClose={close}>
      <Choice
        title={say('view.theme')}
        value={themeChoice.value}
        all={(['system', 'dark', 'light'] as const).map((one) => [one, say(`view.theme.${one}`)] as const)}
        set={(to) => (themeChoice.value = to)}
      />
      <Choice
        title={say('view.units')}
        value={units.value}
        all={[['mm', 'mm'], ['inch', 'inch']] as const}
        set={(to) => (units.value = to)}
      />
      <Choice
        title={say('view.language')}
        value={language.value}
        all={Object.entries(languages) as [Language, string][]}
        set={(to) => (language.value = to)}
      />
      <label class="form-field">
        <span>{say('view.name')}</span>
        <Typed value={givenName.value} placeholder={ownDevice()} take={rename} />
        <span class="dim">{say('view.name.what')}</span>
      </label>
      {ownership.value === 'mine' && (
        <p class="row">
          {say('owner.mine')} <Button onClick={() => attempt(giveUpOwnership)}>{say('owner.give')}</Button>
        </p>
      )}
      <div class="dialog-actions">
        <Button kind="accent" onClick={close}>
          {say('frame.close')}
        </Button>
      </div>
    </Dialog>
  );
}

const shortcuts: readonly [() => string, Key][] = [
  [() => say('keys.space'), 'keys.hold'],
  [() => `1 … ${pages.length}`, 'keys.pages'],
  [() => say('keys.arrows'), 'keys.jog'],
  [() => say('keys.arrows'), 'keys.lines'],
  [() => 'Page Up, Page Down', 'keys.jog.z'],
  [() => say('keys.numpad'), 'keys.keypad'],
  [() => '?', 'keys.help'],
];

function ShortcutsDialog() {
  return (
    <Dialog title={say('frame.shortcuts')} onClose={close}>
      <table class="facts">
        <tbody>
          {shortcuts.map(([key, what]) => (
            <tr key={what}>
              <th scope="row">
                <kbd>{key()}</kbd>
              </th>
              <td>{say(what)}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <div class="dialog-actions">
        <Button kind="accent" onClick={close}>
          {say('frame.close')}
        </Button>
      </div>
    </Dialog>
  );
}

export function ViewDialogs() {
  if (openDialog.value === 'view') return <ViewDialog />;
  return openDialog.value === 'shortcuts' ? <ShortcutsDialog /> : null;
}
