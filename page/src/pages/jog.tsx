import { say } from '../core/language';

export function JogPage() {
  return <h1>{say('page.jog')}</h1>;
}
