// node emulated_pico.js FIRMWARE.uf2 usb|uart SPINDLE PULSES INDEX: an emulated Raspberry Pi Pico in lock-step with the program that started
// it, which speaks to it by its USB socket (usb_host.js) or by its UART.
//
// Time passes only while a request is answered. Requests come on the standard input, answers go to the standard output,
// all numbers little-endian:
//
//   request   u32 size of what follows; f64 the cycle until which to run; u32 pins that are drawn low; u32 pins to watch;
//             u32 after how many rises of these to stop, or 0; u8 1: stop when the board has said a byte, 2: the
//             bytes are for the UART, whatever is plugged in; f64
//             pulses of the spindle's encoder now and f64 at that cycle, u32 pulses a turn, or 0; the bytes for the line
//   answer    u32 size of what follows; f64 the cycle reached; u32 number of changes, for each f64 cycle, u32 levels
//             of the outputs; f64 length of the spindle's pulse as a part of its period; u32 bytes lost in the UART;
//             then the bytes that the board said
//
// SPINDLE, PULSES and INDEX are GPIOs: of the spindle's PWM, and of its encoder.
//
// A cycle is one of the chip's 128 MHz. rp2040js runs the state machines of the PIO beside the program's time; here they
// are stepped in it, a tick every eight cycles, as the firmware sets their clock. Bytes of the UART take ten bits at the
// line's rate of 1 Mbaud.
'use strict';
const fs = require('fs');
const { RP2040 } = require('rp2040js');
const { UsbHost } = require('./usb_host.js');

const cyclesOfTick = 8;
const cyclesOfByte = 10 * 128;
const nanosOfCycle = 1000 / 128;
const bootAddress = 0x20041f00;
const functionPwm = 4;

function loadFlash(chip, path) {
  const file = fs.readFileSync(path);
  for (let at = 0; at + 512 <= file.length; at += 512) {
    const address = file.readUInt32LE(at + 12) - 0x10000000;
    chip.flash.set(file.subarray(at + 32, at + 32 + file.readUInt32LE(at + 16)), address);
  }
}

// As the ROM does: the first 256 bytes of the flash run from RAM, if their checksum is right.
function boot(chip) {
  let sum = 0xffffffff;
  for (let i = 0; i < 252; ++i) {
    sum ^= chip.flash[i] << 24;
    for (let bit = 0; bit < 8; ++bit) sum = sum & 0x80000000 ? (sum << 1) ^ 0x04c11db7 : sum << 1;
  }
  if (sum >>> 0 !== chip.flashView.getUint32(252, true)) throw new Error('the boot code has a wrong checksum');
  chip.sram.set(chip.flash.subarray(0, 256), bootAddress - 0x20000000);
  chip.core.SP = 0x20042000;
  chip.core.PC = bootAddress;
}

class Board {
  constructor(path, line, spindle, pulses, index) {
    this.spindle = spindle;
    this.encoder = { pulses, index, halves: 1, next: Infinity };
    const quiet = () => {};
    this.chip = new RP2040();
    this.chip.logger = { debug: quiet, info: quiet, warn: quiet, error: quiet };
    loadFlash(this.chip, path);
    // Real memory is not empty when the power comes on.
    this.chip.sram.fill(0xc7);
    boot(this.chip);
    this.cycle = 0;
    this.tick = 0;
    this.levels = 0;
    this.changes = [];
    this.coming = []; // by USB
    this.comingByUart = [];
    this.nextByte = 0;
    this.said = [];
    this.lineFree = 0;
    this.lost = 0;
    this.watched = 0;
    this.rises = 0;
    this.stopped = false;
    this.drawnLow = 0;
    const { chip } = this;
    for (const pio of chip.pio) pio.run = () => {};
    for (const pin of chip.gpio) {
      pin.addListener(() => this.look());
      pin.setInputValue(true);
    }
    chip.uart[0].onByte = (byte) => {
      this.lineFree = Math.max(this.lineFree, this.cycle) + cyclesOfByte;
      this.said.push({ byte, at: this.lineFree });
    };
    // rp2040js lets no pin count, and takes the pins of other functions for the slice's.
    const { pwm } = chip;
    pwm.gpioRead = (index) => chip.gpio[index].functionSelect === functionPwm && chip.gpio[index].inputValue;
    pwm.gpioOnInput = (index) => pwm.channels[(index >> 1) & 7].gpioBChanged();
    this.usb = line === 'usb' ? new UsbHost(this) : null;
  }

  // Notes what the outputs are now.
  look() {
    let levels = 0;
    for (const pin of this.chip.gpio) {
      if (pin.functionSelect !== functionPwm && pin.outputEnable && pin.outputValue) levels |= 1 << pin.index;
    }
    levels >>>= 0;
    if (levels === this.levels) return;
    if (levels & ~this.levels & this.watched && --this.rises === 0) this.stopped = true;
    this.levels = levels;
    const last = this.changes[this.changes.length - 1];
    if (last && last.cycle === this.now) {
      last.levels = levels;
    } else {
      this.changes.push({ cycle: this.now, levels });
    }
  }

  setInputs(drawnLow) {
    const turned = drawnLow ^ this.drawnLow;
    this.drawnLow = drawnLow;
    for (const pin of this.chip.gpio) {
      if ((turned >>> pin.index) & 1) pin.setInputValue(((drawnLow >>> pin.index) & 1) === 0);
    }
  }

  // The encoder turns evenly from `from` pulses now to `to` pulses at the cycle `end`. A pulse begins where their
  // number is whole, and lasts half its time. The first pulse of each turn comes with the index, which is low.
  turnEvenly(from, to, perTurn, end) {
    const { encoder } = this;
    Object.assign(encoder, { from, perTurn, begin: this.cycle, slope: (end - this.cycle) / (to - from) });
    this.planEdge();
  }
  planEdge() {
    const { encoder } = this;
    const turns = encoder.perTurn !== 0 && encoder.slope > 0 && Number.isFinite(encoder.slope);
    encoder.next = turns ? encoder.begin + (encoder.halves / 2 - encoder.from) * encoder.slope : Infinity;
  }
  turnEncoder() {
    const { encoder } = this;
    const { gpio } = this.chip;
    const rises = encoder.halves % 2 === 0;
    gpio[encoder.pulses].setInputValue(rises);
    gpio[encoder.index].setInputValue(!rises || (encoder.halves / 2) % encoder.perTurn !== 0);
    ++encoder.halves;
    this.planEdge();
  }

  feed() {
    if (this.cycle < this.nextByte) return;
    const uart = this.chip.uart[0];
    if (uart.rxFIFO.full) {
      ++this.lost;
      this.comingByUart.shift();
    } else {
      uart.feedByte(this.comingByUart.shift());
    }
    this.nextByte = this.cycle + cyclesOfByte;
  }

  run(end, stopsAtByte) {
    const { chip } = this;
    const { core, clock } = chip;
    const pio = chip.pio[0];
    const machine = pio.machines[0];
    this.stopped = false;
    while (this.cycle < end && !this.stopped) {
      this.now = this.cycle;
      if (core.waiting && core.interruptsUpdated && core.checkForInterrupts()) core.waiting = false;
      const cycles = core.waiting ? this.cyclesOfSleep(end, stopsAtByte, machine) : core.executeInstruction();
      clock.tick(cycles * nanosOfCycle);
      this.cycle += cycles;
      this.stepPio(pio, machine);
      if (this.comingByUart.length !== 0) this.feed();
      while (this.encoder.next <= this.cycle) this.turnEncoder();
      if (stopsAtByte && this.said.length !== 0 && this.said[0].at <= this.cycle) break;
    }
  }

  // While the program sleeps, nothing happens before one of these does.
  cyclesOfSleep(end, stopsAtByte, machine) {
    const { clock } = this.chip;
    let until = end;
    if (clock.nextAlarm) until = Math.min(until, this.cycle + Math.ceil(clock.nanosToNextAlarm / nanosOfCycle));
    if (this.comingByUart.length !== 0) until = Math.min(until, this.nextByte);
    until = Math.min(until, Math.ceil(this.encoder.next));
    if (stopsAtByte && this.said.length !== 0) until = Math.min(until, this.said[0].at);
    if (machine.enabled && !machine.waiting) {
      const counted = machine.pc === 2 ? machine.x : 0;
      until = Math.min(until, this.tick + (counted + 1) * cyclesOfTick);
    }
    return Math.max(1, until - this.cycle);
  }

  stepPio(pio, machine) {
    while (this.tick + cyclesOfTick <= this.cycle) {
      const due = Math.floor((this.cycle - this.tick) / cyclesOfTick);
      if (!machine.enabled || machine.waiting) {
        this.tick += due * cyclesOfTick;
        continue;
      }
      // The same as so many steps, but faster: most of its life the machine counts a delay.
      if (machine.pc === 2 && machine.x > 0) {
        const counted = Math.min(due, machine.x);
        machine.x -= counted;
        this.tick += counted * cyclesOfTick;
        continue;
      }
      this.tick += cyclesOfTick;
      this.now = this.tick;
      machine.step();
      if (pio.pinValues !== pio.oldPinValues || pio.pinDirections !== pio.oldPinDirections) pio.checkChangedPins();
    }
  }

  takeSaid() {
    const bytes = [];
    while (this.said.length !== 0 && this.said[0].at <= this.cycle) bytes.push(this.said.shift().byte);
    return bytes;
  }

  duty() {
    const channel = this.chip.pwm.channels[(this.spindle >> 1) & 7];
    const part = ((this.spindle & 1 ? channel.cc >>> 16 : channel.cc) & 0xffff) / (channel.top + 1);
    return this.chip.gpio[this.spindle].outputOverride === 1 ? 1 - part : part;
  }
}

function readFully(size) {
  const buffer = Buffer.alloc(size);
  for (let have = 0; have < size; ) {
    const got = fs.readSync(0, buffer, have, size - have, null);
    if (got === 0) process.exit(0);
    have += got;
  }
  return buffer;
}

function writeFully(buffer) {
  for (let sent = 0; sent < buffer.length; ) sent += fs.writeSync(1, buffer, sent);
}

function answer(board) {
  const said = board.takeSaid();
  const { changes } = board;
  board.changes = [];
  const size = 8 + 4 + 12 * changes.length + 8 + 4 + said.length;
  const buffer = Buffer.alloc(4 + size);
  buffer.writeUInt32LE(size, 0);
  buffer.writeDoubleLE(board.cycle, 4);
  buffer.writeUInt32LE(changes.length, 12);
  let at = 16;
  for (const change of changes) {
    buffer.writeDoubleLE(change.cycle, at);
    buffer.writeUInt32LE(change.levels, at + 8);
    at += 12;
  }
  buffer.writeDoubleLE(board.duty(), at);
  buffer.writeUInt32LE(board.lost, at + 8);
  Buffer.from(said).copy(buffer, at + 12);
  writeFully(buffer);
}

const board = new Board(process.argv[2], process.argv[3], ...process.argv.slice(4).map(Number));
for (;;) {
  const request = readFully(readFully(4).readUInt32LE(0));
  const byUart = !board.usb || (request[20] & 2) !== 0;
  if (board.comingByUart.length === 0) board.nextByte = Math.max(board.nextByte, board.cycle + cyclesOfByte);
  for (const byte of request.subarray(41)) (byUart ? board.comingByUart : board.coming).push(byte);
  if (board.usb) board.usb.feed();
  board.setInputs(request.readUInt32LE(8));
  board.watched = request.readUInt32LE(12);
  board.rises = request.readUInt32LE(16);
  const end = request.readDoubleLE(0);
  board.turnEvenly(request.readDoubleLE(21), request.readDoubleLE(29), request.readUInt32LE(37), end);
  board.run(end, (request[20] & 1) !== 0);
  answer(board);
}
