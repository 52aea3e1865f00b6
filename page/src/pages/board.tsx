// The board: the serial ports of the server's computer, and the machine that answers on one of them.
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { isLive } from '../machine/connection';
import { isSimulated, needOpened, ports } from '../machine/ports';
import { BoardSettings } from '../parts/board_settings';
import { NewMachine } from '../parts/new_machine';
import { PortList } from '../parts/port_list';

export function BoardPart() {
  useEffect(() => {
    if (isLive.value) void needOpened();
  }, [isLive.value]);
  return (
    <>
      <section class="panel" aria-label={say('ports.title')}>
        <h2 class="title">{say('ports.title')}</h2>
        {ports.value !== null && <p>{isSimulated.value ? say('ports.simulated') : say('ports.serves', { board: ports.value.board })}</p>}
        <PortList />
      </section>
      <NewMachine />
      <BoardSettings />
    </>
  );
}
