import { say } from '../core/language';

export function FilesPage() {
  return <h1>{say('page.files')}</h1>;
}
