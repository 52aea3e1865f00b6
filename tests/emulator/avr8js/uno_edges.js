// node uno_edges.js PACKAGES FIRMWARE.hex: an Arduino Uno in avr8js, an emulator that shares nothing with simavr.
//
// Standard input: lines "CYCLE BYTES", the bytes in hexadecimal; from that cycle on they come over the line, each when
// the byte before it is read, and no faster than 500 kbaud. The last line has a cycle only: then all is over.
// Standard output: a line "CYCLE MOTOR DOWN" for each rising edge of a step pin, as CNC Shield V3 has them.
'use strict';
const fs = require('fs');
const path = require('path');
const { CPU, avrInstruction, AVRIOPort, AVRTimer, AVRUSART, ...avr } = require(path.join(process.argv[2], 'avr8js'));

const cyclesOfByte = 320;
const controlA = 0xc0;
const received = 0x80;
const motors = [
  { step: 1 << 2, direction: 1 << 5 },
  { step: 1 << 3, direction: 1 << 6 },
  { step: 1 << 4, direction: 1 << 7 },
];

const program = Buffer.alloc(32768, 0xff);
for (const line of fs.readFileSync(process.argv[3], 'ascii').split(/\r?\n/)) {
  if (line[0] !== ':' || line.slice(7, 9) !== '00') continue;
  Buffer.from(line.slice(9, -2), 'hex').copy(program, parseInt(line.slice(3, 7), 16));
}
const cpu = new CPU(new Uint16Array(program.buffer, program.byteOffset, program.length / 2));
const ports = { B: new AVRIOPort(cpu, avr.portBConfig), C: new AVRIOPort(cpu, avr.portCConfig) };
ports.D = new AVRIOPort(cpu, avr.portDConfig);
new AVRTimer(cpu, avr.timer0Config); // the steps' clock
new AVRTimer(cpu, avr.timer1Config); // the main loop's; the third serves the spindle
const usart = new AVRUSART(cpu, avr.usart0Config, 16e6);
// Every switch is open: the inputs are high.
for (const port of [ports.B, ports.C]) for (let bit = 0; bit < 8; ++bit) port.setPin(bit, true);

const edges = [];
ports.D.addListener((now, before) => {
  const rose = now & ~before;
  motors.forEach((motor, number) => {
    if (rose & motor.step) edges.push(`${cpu.cycles} ${number} ${now & motor.direction ? 1 : 0}`);
  });
});

let free = 0;
for (const line of fs.readFileSync(0, 'ascii').trim().split('\n')) {
  const [from, text] = line.split(' ');
  const bytes = text ? [...Buffer.from(text, 'hex')] : [];
  free = Math.max(free, Number(from));
  while (bytes.length !== 0 || (!text && cpu.cycles < Number(from))) {
    avrInstruction(cpu);
    // All that is due: tick() alone would leave the timer an instruction late beside a byte that was sent.
    do cpu.tick();
    while (cpu.nextClockEvent && cpu.nextClockEvent.cycles <= cpu.cycles);
    if (bytes.length === 0 || cpu.cycles < free || cpu.data[controlA] & received) continue;
    usart.writeByte(bytes.shift(), true);
    free = cpu.cycles + cyclesOfByte;
  }
}
process.stdout.write(edges.join('\n') + '\n');
