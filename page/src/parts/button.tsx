// A button that tells why it cannot be used: a mouse by pointing at it, a finger by pressing it. It stays reachable by the
// keyboard, so that everybody hears the reason.
import type { ComponentChildren } from 'preact';
import { notify } from '../core/notices';
import { Icon, type IconName } from './icon';

interface Props {
  onClick: () => unknown;
  icon?: IconName;
  kind?: 'go' | 'hold' | 'stop' | 'plain' | 'accent';
  why?: string;
  label?: string;
  pressed?: boolean;
  class?: string;
  children?: ComponentChildren;
}

export function Button({ onClick, icon, kind = 'plain', why = '', label, pressed, class: more = '', children }: Props) {
  const off = why !== '';
  return (
    <button
      type="button"
      class={`button ${kind} ${more}`}
      aria-disabled={off}
      aria-label={label === undefined ? undefined : off ? `${label}: ${why}` : label}
      aria-pressed={pressed}
      title={off ? why : undefined}
      onClick={() => (off ? notify('refused', why) : onClick())}
    >
      {icon && <Icon name={icon} />}
      {children !== undefined && <span class="button-words">{children}</span>}
      {off && label === undefined && <span class="unseen">: {why}</span>}
    </button>
  );
}
