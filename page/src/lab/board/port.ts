// The parallel port of the first board's computer: its pins, registers and inverted bits, and which line of the board is on
// which pin.

export const registerNames = ['data', 'status', 'control'] as const;
export type RegisterName = (typeof registerNames)[number];
export const addressOf: Record<RegisterName, number> = { data: 0x378, status: 0x379, control: 0x37a };

export interface PortPin {
  pin: number; // of the DB25
  register: RegisterName;
  bit: number;
  inverted: boolean; // by the port itself: the bit is 1 while the pin is low
}
const pin = (number: number, register: RegisterName, bit: number, inverted = false): PortPin => ({ pin: number, register, bit, inverted });
export const portPins: readonly PortPin[] = [
  pin(1, 'control', 0, true),
  pin(2, 'data', 0), pin(3, 'data', 1), pin(4, 'data', 2), pin(5, 'data', 3),
  pin(6, 'data', 4), pin(7, 'data', 5), pin(8, 'data', 6), pin(9, 'data', 7),
  pin(10, 'status', 6), pin(11, 'status', 7, true), pin(12, 'status', 5), pin(13, 'status', 4),
  pin(14, 'control', 1, true), pin(15, 'status', 3), pin(16, 'control', 2), pin(17, 'control', 3, true),
];
export const isOutput = (one: PortPin): boolean => one.register !== 'status';

// The lines from the computer to the board, in the order of the board's bits, and those back.
export const outputLines = ['clockX', 'clockY', 'clockZ', 'directionX', 'directionY', 'directionZ', 'toolLine'] as const;
export const inputLines = ['endX', 'endY', 'endZ', 'probe', 'emergency'] as const;
export type LineName = (typeof outputLines)[number] | (typeof inputLines)[number];
export const lineNames: readonly LineName[] = [...outputLines, ...inputLines];
const isFromComputer = (line: LineName): boolean => (outputLines as readonly string[]).includes(line);

export interface Wire {
  pin: number; // 0: none
  inverted: boolean; // by the computer's program
}
export type Wiring = Readonly<Record<LineName, Wire>>;

export const pinsFor = (line: LineName): readonly PortPin[] => portPins.filter((one) => isOutput(one) === isFromComputer(line));
export const pinOf = (wiring: Wiring, line: LineName): PortPin | undefined => portPins.find((one) => one.pin === wiring[line].pin);
export const lineOn = (wiring: Wiring, number: number): LineName | undefined => lineNames.find((line) => wiring[line].pin === number);

// The first two lines on one pin.
export function conflictIn(wiring: Wiring): readonly [LineName, LineName] | undefined {
  for (const line of lineNames) {
    const other = wiring[line].pin === 0 ? undefined : lineOn(wiring, wiring[line].pin);
    if (other !== undefined && other !== line) return [other, line];
  }
  return undefined;
}

const usualPins = [2, 3, 4, 5, 6, 7, 8, 10, 12, 13, 15, 11];
const wiringOf = (wires: readonly Wire[]): Wiring =>
  Object.fromEntries(lineNames.map((line, i) => [line, wires[i] ?? { pin: 0, inverted: false }])) as unknown as Wiring;

// In the address: "2.3.4.5i", a pin for each line, with i where it is inverted.
export const wiringField = {
  usual: wiringOf(usualPins.map((number) => ({ pin: number, inverted: false }))),
  read: (text: string): Wiring | undefined => {
    const wires = text.split('.').map((word) => ({ pin: Number.parseInt(word, 10), inverted: word.endsWith('i') }));
    if (wires.length !== lineNames.length || !/^(\d+i?\.)*\d+i?$/.test(text)) return undefined;
    const wiring = wiringOf(wires);
    const fits = lineNames.every((line) => wiring[line].pin === 0 || pinsFor(line).some((one) => one.pin === wiring[line].pin));
    return fits && conflictIn(wiring) === undefined ? wiring : undefined;
  },
  write: (wiring: Wiring): string => lineNames.map((line) => `${wiring[line].pin}${wiring[line].inverted ? 'i' : ''}`).join('.'),
  expects: '2.3i.4 …',
};

// What the computer's program has written, and what the board gives back.
export interface Registers {
  data: number;
  control: number;
  status: number;
}
export const bitOf = (registers: Registers, one: PortPin): number => (registers[one.register] >> one.bit) & 1;
export const levelOf = (registers: Registers, one: PortPin): number => bitOf(registers, one) ^ (one.inverted ? 1 : 0);
export function withLevel(registers: Registers, one: PortPin, level: number): Registers {
  const bit = level ^ (one.inverted ? 1 : 0);
  const others = registers[one.register] & ~(1 << one.bit);
  return { ...registers, [one.register]: others | (bit << one.bit) };
}

// All lines off, as their wires are inverted or not; pins without a line are low.
export function restingRegisters(wiring: Wiring): Registers {
  let registers: Registers = { data: 0, control: 0, status: 0 };
  for (const one of portPins) {
    const line = lineOn(wiring, one.pin);
    registers = withLevel(registers, one, line !== undefined && wiring[line].inverted ? 1 : 0);
  }
  return registers;
}

// The levels that reach the board, a bit for each of the output lines. A line without a wire is low.
export function boardLines(wiring: Wiring, registers: Registers): number {
  return outputLines.reduce((lines, line, i) => {
    const one = pinOf(wiring, line);
    return lines | ((one === undefined ? 0 : levelOf(registers, one)) << i);
  }, 0);
}
export function withBoardLines(wiring: Wiring, registers: Registers, lines: number): Registers {
  return outputLines.reduce((now, line, i) => {
    const one = pinOf(wiring, line);
    return one === undefined ? now : withLevel(now, one, (lines >> i) & 1);
  }, registers);
}
// A line as the program means it: on or off, whatever the wire inverts.
export function withLine(wiring: Wiring, registers: Registers, line: LineName, on: boolean): Registers {
  const one = pinOf(wiring, line);
  return one === undefined ? registers : withLevel(registers, one, (on ? 1 : 0) ^ (wiring[line].inverted ? 1 : 0));
}

export const hex = (value: number, digits = 2): string => `0x${value.toString(16).toUpperCase().padStart(digits, '0')}`;
