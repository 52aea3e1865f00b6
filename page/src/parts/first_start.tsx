// On the first page of a server without a board: the ports on which a machine may be.
import { useEffect } from 'preact/hooks';
import { kept } from '../core/kept';
import { say, sayCount } from '../core/language';
import { isSimulated, ports, watchPorts } from '../machine/ports';
import { Button } from './button';
import { PortList } from './port_list';

const isHidden = kept('first-start.hidden', false, (value): value is boolean => typeof value === 'boolean');

export function FirstStart() {
  useEffect(() => (isHidden.value ? undefined : watchPorts()), [isHidden.value]);
  if (isHidden.value || !isSimulated.value || ports.value === null) return null;
  const count = ports.value.ports.length;
  return (
    <details class="panel first-start" open={count > 0}>
      <summary>
        <b>{say('ports.title')}</b> <span class="dim">{count === 0 ? say('ports.none.found') : sayCount('ports.count', count)}</span>
      </summary>
      <div class="first-start-words">
        <p>{say('ports.simulated')}</p>
        <Button onClick={() => (isHidden.value = true)}>{say('ports.hide')}</Button>
      </div>
      <PortList isBrief />
    </details>
  );
}
