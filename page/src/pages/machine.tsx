import { say } from '../core/language';

export function MachinePage() {
  return <h1>{say('page.machine')}</h1>;
}
