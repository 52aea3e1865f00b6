// The host at the other end of the emulated Pico's USB cable. It greets the device as Linux does: it reads the
// descriptors, gives an address, configures the device, and opens its serial line. Then bytes go both ways, in packets
// that take the time that they take on a bus of 12 Mbit/s.
//
// A device that does not keep to USB 2.0 ends the emulator with a message. rp2040js does not look at the order of
// DATA0 and DATA1; a real host does, so this host does, too.
'use strict';

const cyclesOfBit = 128 / 12;
const bitsAround = 13 * 8; // token, start and check of the data, the answer, pauses
const packetSize = 64;
const alternate = { device: 1, configuration: 2, string: 3, qualifier: 6 };
const second = 1 << 13;
const available = 1 << 10;

function fail(what) {
  throw new Error(`USB: ${what}`);
}
function expect(what, is, wanted) {
  if (is !== wanted) fail(`${what} is ${is}, not ${wanted}`);
}

class UsbHost {
  constructor(board) {
    this.board = board;
    this.usb = board.chip.usbCtrl;
    this.open = false;
    this.busFree = 0;
    this.waiting = null; // the packet that the device has room for
    this.toggles = new Map();
    const { usb } = this;
    const { clock } = board.chip;
    usb.onUSBEnabled = () => usb.resetDevice();
    usb.onResetReceived = () => {
      this.toggles.clear();
      if (this.steps) return this.proceed();
      this.steps = this.greet();
      this.steps.next();
    };
    usb.onEndpointWrite = (endpoint, buffer) => this.hear(endpoint, buffer);
    usb.onEndpointRead = (endpoint) => this.offer(endpoint);
    const updated = usb.DPRAMUpdated.bind(usb);
    usb.DPRAMUpdated = (offset, value) => {
      if (value & available && offset >= 0x80 && offset < 0x100) this.watch((offset - 0x80) >> 2, value);
      updated(offset, value);
    };
    // A packet to the host is gone when the bus has carried it, not when it is ready.
    const ready = usb.indicateBufferReady.bind(usb);
    usb.indicateBufferReady = (endpoint, out) => {
      if (out) return ready(endpoint, out);
      clock.createAlarm(() => ready(endpoint, out)).schedule(usb.writeDelayMicroseconds * 1000);
    };
    this.patience = clock.createAlarm(() => {
      if (!(usb.epStallArm & 1)) fail(`no answer to the request ${[...this.setup]}`);
      usb.epStallArm = 0;
      this.finish(null);
    });
  }

  now() {
    return Math.round((this.board.chip.clock.nanos * 128) / 1000);
  }
  // Microseconds until a packet of so many bytes is over.
  carry(bytes) {
    const cycle = this.now();
    this.busFree = Math.max(this.busFree, cycle) + (bytes * 8 + bitsAround) * cyclesOfBit;
    return (this.busFree - cycle) / 128;
  }

  // Each packet of an endpoint's direction has the other number than the one before.
  watch(place, value) {
    const endpoint = place >> 1;
    if ((place & 1) === 0) this.usb.writeDelayMicroseconds = this.carry(value & 0x3ff);
    if (endpoint === 0) {
      // An empty packet the other way ends a request; its number is always DATA1.
      const ends = ((this.setup[0] & 0x80) === 0) === ((place & 1) === 0);
      expect('the number of a packet of endpoint 0', Boolean(value & second), ends || this.controlPid);
      if (!ends) this.controlPid = !this.controlPid;
      return;
    }
    expect(`the number of a packet of ${place}`, Boolean(value & second), this.toggles.get(place) ?? false);
    this.toggles.set(place, Boolean(value & second) === false);
  }

  // The steps.
  *greet() {
    const begin = yield this.control([0x80, 6, 0, alternate.device, 0, 0, 64, 0]);
    expect('the size of a packet of endpoint 0', begin[7], packetSize);
    yield this.usb.resetDevice();
    yield this.control([0, 5, 23, 0, 0, 0, 0, 0]);
    yield this.pause();
    expect('the address', this.usb.addrEndp & 127, 23);
    const device = yield this.control([0x80, 6, 0, alternate.device, 0, 0, 18, 0]);
    expect('the size of a device descriptor', device.length, 18);
    expect('the class', device[4], 2);
    const head = yield this.control([0x80, 6, 0, alternate.configuration, 0, 0, 9, 0]);
    const total = head[2] | (head[3] << 8);
    const all = yield this.control([0x80, 6, 0, alternate.configuration, 0, 0, total & 255, total >> 8]);
    expect('the size of the configuration', all.length, total);
    this.study(all);
    yield this.control([0x80, 6, 0, alternate.string, 0, 0, 255, 0]);
    for (const which of [device[14], device[15]]) {
      const text = yield this.control([0x80, 6, which, alternate.string, 9, 4, 255, 0]);
      expect('the size of a string', text.length, text[0]);
    }
    expect('a qualifier', yield this.control([0x80, 6, 0, alternate.qualifier, 0, 0, 10, 0]), null);
    yield this.control([0, 9, all[5], 0, 0, 0, 0, 0]);
    const coding = [0, 0xc2, 1, 0, 0, 0, 8];
    yield this.control([0x21, 0x20, 0, 0, 0, 0, 7, 0], coding);
    const read = yield this.control([0xa1, 0x21, 0, 0, 0, 0, 7, 0]);
    expect('the line coding', String([...read]), String(coding));
    yield this.control([0x21, 0x22, 3, 0, 0, 0, 0, 0]);
    this.open = true;
    this.feed();
  }
  // What class drivers look for.
  study(bytes) {
    let place = null;
    let endpoints = 0;
    const seen = { functional: [] };
    for (let at = 0; at < bytes.length; at += bytes[at]) {
      const [length, type] = [bytes[at], bytes[at + 1]];
      if (length < 2 || at + length > bytes.length) fail('a descriptor of a wrong length');
      if (type === 4) {
        expect('the number of endpoints', endpoints, 0);
        place = bytes[at + 5];
        endpoints = bytes[at + 4];
      }
      if (type === 0x24) seen.functional.push(bytes[at + 2]);
      if (type === 5) {
        --endpoints;
        if (place === 10) {
          expect('the kind of an endpoint', bytes[at + 3], 2);
          seen[bytes[at + 2] & 0x80 ? 'in' : 'out'] = bytes[at + 2] & 15;
        }
      }
    }
    expect('what the interface of control tells', String(seen.functional), '0,1,2,6');
    if (!seen.in || !seen.out) fail('an endpoint is missing');
    this.in = seen.in;
    this.out = seen.out;
  }

  // One request: eight bytes, and the data that go with it.
  control(setup, data = []) {
    this.setup = setup;
    this.data = data;
    this.came = [];
    this.controlPid = true;
    this.patience.schedule(2e6);
    this.usb.sendSetupPacket(new Uint8Array(setup));
  }
  pause() {
    this.board.chip.clock.createAlarm(() => this.proceed()).schedule(2e6);
  }
  finish(result) {
    this.patience.cancel();
    this.proceed(result);
  }
  proceed(result) {
    this.steps.next(result);
  }

  hear(endpoint, buffer) {
    if (endpoint === this.in && this.open) {
      if (buffer.length === packetSize) fail('a full packet, which says that more follows');
      for (const byte of buffer) this.board.said.push({ byte, at: this.now() });
      return;
    }
    if (endpoint !== 0) return;
    if (!(this.setup[0] & 0x80)) return this.finish(buffer);
    this.came.push(...buffer);
  }
  offer(endpoint) {
    if (endpoint === this.out) {
      this.waiting = endpoint;
      return this.feed();
    }
    if (endpoint !== 0) return;
    if (this.setup[0] & 0x80) return this.finish(this.came);
    this.usb.endpointReadDone(0, new Uint8Array(this.data), this.carry(this.data.length));
  }
  // Sends what waits for the line, if the device has room.
  feed() {
    const { coming } = this.board;
    if (!this.open || this.waiting === null || coming.length === 0) return;
    const packet = coming.splice(0, packetSize);
    this.waiting = null;
    this.usb.endpointReadDone(this.out, new Uint8Array(packet), this.carry(packet.length));
  }
}

module.exports = { UsbHost };
