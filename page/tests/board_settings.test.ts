import { describe, expect, it } from 'vitest';
import { byGroup, hasBit, rangeOf, sought, unitOf, withBit, type Setting } from '../src/machine/board_settings';
import { fileNameFor, idOf, nameOf, usersOf, type Port } from '../src/machine/ports';

const setting = (name: string, more: Partial<Setting> = {}): Setting => ({
  name, value: '0', title: '', unit: '', group: '', meaning: '', kind: 'number', least: null, most: null, zero_too: false, choices: [], needs_restart: false, read_only: false, ...more,
});

describe('settings of a board', () => {
  it('are found by all the words that are typed, in any field', () => {
    const all = [setting('$110', { title: 'Maximum rate of X', unit: 'mm/min' }), setting('$132', { title: 'Travel of Z', meaning: 'The way from end to end' })];
    expect(sought(all, '').length).toBe(2);
    expect(sought(all, 'RATE x').map((one) => one.name)).toEqual(['$110']);
    expect(sought(all, '132 end').map((one) => one.name)).toEqual(['$132']);
    expect(sought(all, 'rate z')).toEqual([]);
  });

  it('stay together by group, in the order of the board', () => {
    const all = [setting('$1', { group: 'Steppers' }), setting('$3', { group: 'Axis X' }), setting('$2', { group: 'Steppers' })];
    expect(byGroup(all).map(([group, rows]) => `${group}: ${rows.map((one) => one.name).join(' ')}`)).toEqual(['Steppers: $1 $2', 'Axis X: $3']);
  });

  it('tell their range', () => {
    expect(rangeOf(setting('$0'))).toBe('');
    expect(rangeOf(setting('$0', { least: 3, most: 1000, zero_too: true }))).toBe('0, 3 … 1000');
    expect(rangeOf(setting('$0', { least: 0.1 }))).toBe('≥ 0.1');
    expect(rangeOf(setting('$0', { most: 255 }))).toBe('≤ 255');
  });

  it('have the usual signs for their units', () => {
    const units = ['us', 'microseconds', 'mm/s^2', 'mm/sec^2', 'mm/min', 'milliseconds', ''].map((unit) => unitOf(setting('$0', { unit })));
    expect(units).toEqual(['µs', 'µs', 'mm/s²', 'mm/s²', 'mm/min', 'ms', '']);
  });

  it('are sums of bits, of which one is changed at a time', () => {
    expect(withBit('5', 1, true)).toBe('7');
    expect(withBit('5', 0, false)).toBe('4');
    expect(withBit('nonsense', 3, true)).toBe('8');
    expect([hasBit('6', 1), hasBit('6', 0)]).toEqual([true, false]);
  });
});

describe('a serial port', () => {
  const port: Port = {
    device: '/dev/ttyACM0',
    lasting_name: '/dev/serial/by-id/uno',
    usb: { vendor: '2341', product: '0043', manufacturer: 'Arduino', product_name: 'Arduino Uno', serial_number: '' },
    users: [{ process: 12, program: 'cncjs' }, { process: null, program: '' }],
  };

  it('has a name, its ids and its users', () => {
    expect(nameOf(port)).toBe('Arduino Uno');
    expect(nameOf({ ...port, usb: { ...port.usb, product_name: 'Uno' } })).toBe('Arduino Uno');
    expect(idOf(port)).toBe('2341:0043');
    expect(usersOf(port, 'another program')).toBe('cncjs (12), another program');
  });

  it('gives a machine file a name that every computer takes', () => {
    expect(fileNameFor('Grbl Arduino__www.arduino.cc__0043')).toBe('grbl-arduino-www-arduino-cc-0043.toml');
    expect(fileNameFor('../..')).toBe('machine.toml');
  });
});
