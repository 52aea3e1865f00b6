// The port's window: the connector with its levels, and the three registers, bit by bit.
import type { JSX } from 'preact';
import { say } from '../words';
import {
  addressOf, bitOf, hex, isOutput, levelOf, lineOn, type LineName, type PortPin, portPins, registerNames, type RegisterName, type Registers,
  type Wiring,
} from './port';

export const lineWords = (line: LineName): string => say(`line_${line}`);
const shortWords = (line: LineName): string => say(`short_${line}`);

interface PortProps {
  wiring: Wiring;
  registers: Registers;
  onToggle: (pin: PortPin) => void;
}

// As seen from outside: pin 1 on the right of the upper row, 14 below it.
function spotOf(number: number): [number, number] {
  return number <= 13 ? [332 - (number - 1) * 26, 34] : [319 - (number - 14) * 26, 66];
}

function titleOf(one: PortPin, wiring: Wiring, registers: Registers): string {
  const line = lineOn(wiring, one.pin);
  return `${say('pinNumber', { n: one.pin })}: ${one.register[0]?.toUpperCase()}${one.bit}${line === undefined ? '' : `, ${lineWords(line)}`}, ${say(levelOf(registers, one) ? 'levelHigh' : 'levelLow')}`;
}

function Connector({ wiring, registers, onToggle }: PortProps): JSX.Element {
  return (
    <svg class="lab-connector" viewBox="0 0 352 100" role="img" aria-label={say('connector')}>
      <path d="M14 8H338Q350 8 348 20L338 80Q335 92 324 92H28Q17 92 14 80L4 20Q2 8 14 8z" />
      {Array.from({ length: 25 }, (_, i) => i + 1).map((number) => {
        const one = portPins.find((each) => each.pin === number);
        const [x, y] = spotOf(number);
        const level = one !== undefined && levelOf(registers, one) === 1;
        const kind = one === undefined ? 'ground' : isOutput(one) ? 'out' : 'in';
        return (
          <g key={number} class={`${kind}${level ? ' high' : ''}`} transform={`translate(${x} ${y})`} onClick={() => one !== undefined && isOutput(one) && onToggle(one)}>
            <circle r="11.5" />
            <text>{number}</text>
            <title>{one === undefined ? `${say('pinNumber', { n: number })}: ${say('ground')}` : titleOf(one, wiring, registers)}</title>
          </g>
        );
      })}
    </svg>
  );
}

function Bit({ one, wiring, registers, onToggle }: PortProps & { one: PortPin }): JSX.Element {
  const line = lineOn(wiring, one.pin);
  const inner = (
    <>
      <span class={one.inverted ? 'lab-bit-name inverted' : 'lab-bit-name'}>{`${one.register[0]?.toUpperCase()}${one.bit}`}</span>
      <b>{bitOf(registers, one)}</b>
      <span class={levelOf(registers, one) ? 'lab-level high' : 'lab-level'} aria-hidden="true" />
      <small>{say('pinShort', { n: one.pin })}</small>
      <small class="lab-bit-line">{line === undefined ? '–' : shortWords(line)}</small>
    </>
  );
  const title = titleOf(one, wiring, registers);
  if (!isOutput(one)) return <div class="lab-bit" title={title}>{inner}</div>;
  return (
    <button type="button" class="lab-bit" title={title} aria-pressed={bitOf(registers, one) === 1} data-pin={one.pin} onClick={() => onToggle(one)}>
      {inner}
    </button>
  );
}

function Register({ name, ...port }: PortProps & { name: RegisterName }): JSX.Element {
  const value = port.registers[name];
  return (
    <div class="lab-register" role="group" aria-label={say(`register_${name}`)}>
      <p>
        <b>{say(`register_${name}`)}</b> <code>{hex(addressOf[name], 3)}</code> <output data-register={name}>{hex(value)}</output>
      </p>
      <div class="lab-bits">
        {[7, 6, 5, 4, 3, 2, 1, 0].map((bit) => {
          const one = portPins.find((each) => each.register === name && each.bit === bit);
          return one === undefined ? <div key={bit} class="lab-bit none" aria-hidden="true" /> : <Bit key={bit} one={one} {...port} />;
        })}
      </div>
    </div>
  );
}

export function PortView(port: PortProps): JSX.Element {
  return (
    <>
      <Connector {...port} />
      {registerNames.map((name) => (
        <Register key={name} name={name} {...port} />
      ))}
    </>
  );
}
