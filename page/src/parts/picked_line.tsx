// The line that a person has picked, in the text or in the scene, and the start there.
import { say } from '../core/language';
import { whyNoStart } from '../machine/actions';
import { startAt } from '../machine/way_back';
import { picked } from '../scene/stage';
import { Button } from './button';
import { Icon } from './icon';

export function PickedLine() {
  const line = picked.value;
  if (line === null) return null;
  return (
    <div class="picked-line" role="group" aria-label={say('run.line', { line })}>
      <Button icon="run" why={whyNoStart.value} onClick={() => startAt(line)}>
        {say('way.start', { line })}
      </Button>
      <button type="button" class="bare" aria-label={say('way.unpick')} onClick={() => (picked.value = null)}>
        <Icon name="close" />
      </button>
    </div>
  );
}
