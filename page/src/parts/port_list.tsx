// The serial ports, and who uses them. One that is free is opened after a warning.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { say } from '../core/language';
import { confirm } from '../core/question';
import { goTo } from '../core/route';
import { whyNot } from '../machine/actions';
import { idOf, nameOf, opened, openPort, ports, usersOf, watchPorts, type Port } from '../machine/ports';
import { Button } from './button';
import { SelectField } from './select';
import { Typed } from './typed';

const rates = [9600, 57_600, 115_200, 230_400, 250_000, 460_800, 921_600, 1_000_000] as const;
const rate = signal(115_200);

async function connect(port: Port): Promise<void> {
  const yes = await confirm({
    title: say('ports.open.ask', { name: nameOf(port) === '' ? port.device : nameOf(port) }),
    facts: [say('ports.open.restarts'), ...(ports.value?.sees_all_programs === false ? [say('ports.hidden')] : []), say('ports.open.reads')],
    rows: [[say('ports.device'), port.device], [say('ports.rate'), String(rate.value)]],
    yes: say('ports.open'),
    kind: 'plain',
  });
  if (!yes) return;
  goTo('machine?part=board');
  await openPort(port.device, rate.value);
}

const address = signal('');

// A machine on the network does not restart when it is connected to.
function Network() {
  const why = opened.value?.state === 'running' ? say('ports.reading') : whyNot('Idle', 'Alarm', 'Sleep');
  return (
    <div class="row">
      <label class="form-field">
        <span class="dim">{say('ports.network')}</span>
        <Typed value={address.value} take={(typed) => (address.value = typed.trim())} placeholder="192.168.1.20:23" aria-label={say('ports.network')} />
      </label>
      <Button icon="plug" why={address.value === '' ? say('ports.network.what') : why} label={say('ports.connect.to', { device: say('ports.network') })} onClick={() => openPort(`tcp:${address.value}`)}>
        {say('ports.connect')}
      </Button>
    </div>
  );
}

function Row({ port, isBrief }: { port: Port; isBrief: boolean }) {
  const users = usersOf(port, say('ports.program.unknown'));
  const busy = port.users.length > 0;
  const why = busy ? say('ports.busy', { users }) : opened.value?.state === 'running' ? say('ports.reading') : whyNot('Idle', 'Alarm', 'Sleep');
  return (
    <li class="port">
      <div>
        <b>{nameOf(port) === '' ? say('ports.nameless') : nameOf(port)}</b>
        <span class="dim">
          <code>{idOf(port)}</code> <code>{port.device}</code>
        </span>
        {port.lasting_name !== port.device && !isBrief && (
          <span class="dim">
            <code>{port.lasting_name}</code>
          </span>
        )}
        <span class={busy ? 'port-busy' : 'dim'}>{busy ? say('ports.busy', { users }) : say('ports.free')}</span>
      </div>
      <Button kind="accent" icon="plug" why={why} label={say('ports.connect.to', { device: port.device })} onClick={() => connect(port)}>
        {say('ports.connect')} …
      </Button>
    </li>
  );
}

// `isBrief`: on the first page, where the list stands above the work.
export function PortList({ isBrief = false }: { isBrief?: boolean }) {
  useEffect(watchPorts, []);
  const known = ports.value;
  if (known === null) return <p class="dim">{say('frame.loading')}</p>;
  return (
    <>
      {known.ports.length === 0 && <p role="status">{say('ports.none.found')}</p>}
      {known.ports.length > 0 && (
        <ul class="ports">
          {known.ports.map((port) => (
            <Row key={port.device} port={port} isBrief={isBrief} />
          ))}
        </ul>
      )}
      {known.ports.length > 0 && !isBrief && (
        <SelectField class="port-rate" title={say('ports.rate')} value={String(rate.value)} all={rates.map((one) => [String(one), String(one)] as const)} set={(to) => (rate.value = Number(to))} />
      )}
      {!isBrief && <Network />}
      {!known.sees_all_programs && known.ports.length > 0 && <p class="dim">{say('ports.hidden')}</p>}
    </>
  );
}
