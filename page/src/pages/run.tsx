import { say } from '../core/language';

export function RunPage() {
  return <h1>{say('page.run')}</h1>;
}
