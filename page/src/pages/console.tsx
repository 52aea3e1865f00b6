import { say } from '../core/language';

export function ConsolePage() {
  return <h1>{say('page.console')}</h1>;
}
