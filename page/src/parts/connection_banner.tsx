// A lost connection cannot be overlooked.
import { useEffect, useState } from 'preact/hooks';
import { say } from '../core/language';
import { connection, heardAt } from '../machine/connection';
import { giveToken } from '../machine/token';
import { Icon } from './icon';

export function ConnectionBanner() {
  const [, setTick] = useState(0);
  const lost = connection.value === 'lost';
  useEffect(() => {
    if (!lost) return undefined;
    const timer = setInterval(() => setTick((n) => n + 1), 1000);
    return () => clearInterval(timer);
  }, [lost]);
  if (connection.value === 'token') return <TokenForm />;
  if (!lost) return null;
  const seconds = Math.max(2, Math.round((performance.now() - heardAt.peek()) / 1000));
  return (
    <div class="lost" role="alert">
      <Icon name="lost" />
      <div>
        <strong>{say('connection.lost')}</strong>
        {heardAt.peek() > 0 && <span aria-live="off"> {say('connection.lost.old', { seconds })}</span>}
        <p>{say('connection.lost.what')}</p>
      </div>
    </div>
  );
}

function TokenForm() {
  const use = (event: SubmitEvent): void => {
    event.preventDefault();
    const field = (event.currentTarget as HTMLFormElement).elements.namedItem('token');
    if (field instanceof HTMLInputElement) giveToken(field.value);
    connection.value = 'connecting';
  };
  return (
    <form class="lost" onSubmit={use}>
      <Icon name="lost" />
      <div>
        <strong>{say('connection.token')}</strong>
        <p>{say('connection.token.what')}</p>
      </div>
      <input name="token" type="password" autocomplete="off" aria-label={say('connection.token')} />
      <button class="button accent" type="submit">
        {say('connection.token.use')}
      </button>
    </form>
  );
}
