// Messages: the content of frames and how it is laid out. docs/wire.md describes each message byte by byte. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"
#include "passo/wire/item_sums.hpp"
#include "passo/wire/segment_message.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

// Host to board, the first message. Its sequence number starts the counting: the first frame has the next number.
struct Hello {
  uint8_t version = protocol_version;
  uint8_t motors = 0;  // the number of increments of each segment
};

// The board's answer: its properties.
struct HelloReply {
  uint8_t version = protocol_version;
  uint8_t motors = 0;    // the most motors it can turn
  uint8_t capacity = 0;  // items that it holds, including the one being played
  uint32_t clock = 0;    // ticks a second
};

// How long a host may be silent before the board, at rest, switches an output off: tenths of a second, 0 for ever.
struct Silence {
  uint8_t spindle = 0;
  uint8_t mist = 0;
  uint8_t flood = 0;
};

// Host to board, after a hello. By this number the host recognises the board again after the line was broken. A board
// that was reset meanwhile has the number 0.
struct Session {
  uint16_t number = 0;
  Silence silence = {};
};

// What the drivers ask of the step and direction pins, in sixteenths of a microsecond. The host says the least that it
// needs, and the board answers what it gives. Longer times may leave the board fewer events a second.
struct StepTiming {
  uint8_t pulse = 0;         // how long a step pulse lasts
  uint8_t set_up = 0;        // from a change of the direction to the edge that begins a step
  uint8_t hold = 0;          // from the edge that begins a step to a change of the direction
  uint16_t event_ticks = 0;  // the fewest ticks of the board's clock from event to event; 0: any number

  friend constexpr bool operator==(const StepTiming& a, const StepTiming& b) {
    return a.pulse == b.pulse && a.set_up == b.set_up && a.hold == b.hold && a.event_ticks == b.event_ticks;
  }
};

// Host to board, before a hello: what is connected to the board's pins. It counts for that hello, and until a hello
// without one. Board to host, as the answer: the setup that the board now has. What it cannot do is left out.
//
// As usual an input is on when it is low, and an output is on when it is high. The driver's enable is on when it is
// low. A bit that is set means the opposite.
struct PinSetup {
  uint16_t inputs = 0;       // bits: BoardInput
  uint8_t steps = 0;         // bit m: the step pin of motor m
  uint8_t outputs = 0;       // bits: OutputSwitch, and inverted_enable
  uint8_t drivers_rest = 0;  // after so many tenths of a second without host or motion drivers are off; 0: never
  StepTiming timing = {};
  uint16_t alarms = 0;  // bits of BoardInput: these inputs are alarms of drives, which stop the motors
  uint8_t filter = 0;   // microseconds for which a switch must have kept its new state before that counts

  friend constexpr bool operator==(const PinSetup& a, const PinSetup& b) {
    return a.inputs == b.inputs && a.steps == b.steps && a.outputs == b.outputs && a.drivers_rest == b.drivers_rest &&
           a.timing == b.timing && a.alarms == b.alarms && a.filter == b.filter;
  }
};
inline constexpr uint8_t inverted_enable = 0x10;

// Host to board. The next `count` frames are items. They replace everything that the board holds after item `after`, as
// soon as the last of them has come.
struct Replace {
  uint16_t after = 0;
  uint8_t count = 0;   // at least 1
  ItemSums sums = {};  // everything is added to them; the result must be 0
};

// Host to board, at any time: a question about the board's state. Like hello and session it is not counted. Its
// sequence number is one of its own; the answer repeats it to show which question it answers.
enum class Question : uint8_t {
  status = 0,
  about = 1,
  watch = 2,    // from now on keep where the probe, or the named limit switch, changes first; the answer is a status
  kept = 3,     // what was kept; the answer is a captured
  spindle = 8,  // the spindle's place; the answer is a turned, or a status if the board has no encoder
};
struct Ask {
  uint8_t version = protocol_version;
  uint8_t motors = 0;  // the number of positions wanted
  Question question = Question::status;
  uint8_t limit = 0;  // for watch: the bit of the limit switch that captures instead of stopping; 0: the probe
};

// Board to host: progress. Each credit repeats all that earlier ones said, so a lost one is not missed.
struct Credit {
  uint16_t executed = 0;  // number of the last item done
  uint8_t taken = 0;      // sequence number of the last frame taken
  uint8_t free = 0;       // free places for items
};

enum class WireError : uint8_t {
  bad_frame = 1,        // cut short, of no known type, or with a wrong CRC
  out_of_sequence = 2,  // a frame before this one is missing
  queue_full = 3,       // the host did not heed its credits
  bad_value = 4,        // a segment without events, faster than the board, or for a motor that does not exist
  unexpected = 5,       // a message that only the board sends, or a hello during motion
  too_late = 6,         // an item after the one to replace after has begun; the replacement is dropped
  manual = 7,           // a person moves the machine, or did since the hello: say hello again afterwards
  wrong_sums = 8,       // items came that were not sent: the replacement is dropped
  silent_host = 9,      // the host was silent, and outputs are off: send outputs first. The replacement is dropped
};

// Board to host: a frame was not taken.
struct ErrorReport {
  WireError reason = WireError::bad_frame;
  uint8_t expected = 0;  // sequence number of the frame that the board expects
};

enum class ResetCause : uint8_t { power_on = 0, brown_out = 1, watchdog = 2, button = 3 };
enum BoardState : uint8_t {
  board_moves = 1,     // the board plays something
  board_trusted = 2,   // since the hello the motors have made every step counted, as far as the board knows
  board_replaces = 4,  // a replacement still waits for items
  board_slipped = 8,  // since the hello it could not make events in time and stood still during motion. No step is lost
  board_kept = 16,    // since it was told to watch, the watched input has changed
  board_manual = 32,  // a person moves the machine by the board's keypad
  board_homes = 64,   // a limit switch captures instead of stopping
  board_encodes = 128,  // the spindle has an encoder
};
// The board's input pins. A bit is set if the switch is on.
enum BoardInput : uint16_t {
  input_limit = 1,  // motor 0; the next seven bits are motors 1…7
  input_probe = 0x100,
  input_door = 0x200,
  input_emergency_stop = 0x400,
  input_hold = 0x800,
  input_start = 0x1000,
};
// A further bit in the inputs of a status: the host was silent, outputs are off, and no motion is taken before outputs.
inline constexpr uint16_t outputs_timed_out = 0x2000;
// Another one: the host was silent and the board has switched the drivers off, so the place is not trusted.
inline constexpr uint16_t drivers_timed_out = 0x4000;
// Further bits in the input of a captured.
inline constexpr uint16_t captured_kept = 0x4000;      // this answers a question
inline constexpr uint16_t captured_released = 0x8000;  // the input has gone off

// Board to host, as an answer. Positions are the motors' steps since the board was switched on. `room` is the number of
// motors that there are places for.
template <uint8_t room>
struct BoardStatusFor {
  uint16_t session = 0;
  uint16_t executed = 0;  // this and the next two as in a credit
  uint8_t taken = 0;
  uint8_t free = 0;
  uint16_t event = 0;  // events of the present item that are played
  uint8_t state = 0;   // bits: BoardState
  ResetCause reset = ResetCause::power_on;
  uint8_t motors = 0;   // agreed with the host; 0: no hello since the reset
  uint16_t inputs = 0;  // bits: BoardInput
  uint8_t answers = 0;  // sequence number of the question it answers
  int32_t positions[room] = {};
};
using BoardStatus = BoardStatusFor<max_motors>;

// Board to host: at this very event a watched input has changed. As an answer: where the watched input changed first.
// Without an input in it, there was no change and there is no item.
template <uint8_t room>
struct CapturedFor {
  uint16_t input = 0;  // BoardInput, captured_kept, captured_released
  uint8_t item = 0;    // low byte of the number of the item being played
  uint16_t event = 0;  // events of that item that were played
  int32_t positions[room] = {};
};
using Captured = CapturedFor<max_motors>;

// What a board's encoder counted, and when. Counts and ticks start anywhere and run on modulo 2^32.
struct SpindleCount {
  uint32_t count = 0;
  uint32_t tick = 0;      // of the board's clock, at the count
  uint32_t at_index = 0;  // the count at the last index
  uint8_t indexes = 0;    // index pulses so far, modulo 256
};

// Board to host, as an answer: the spindle's place, and the motion's place at the same tick. It tells everything that a
// credit does.
struct Turned {
  Credit progress = {};
  uint16_t event = 0;   // events of the present item that were played
  uint8_t answers = 0;  // sequence number of the question it answers
  SpindleCount spindle = {};
};

// Board to host: the motors were stopped at once. From here on positions are not trusted. A hello begins anew.
enum class FaultReason : uint8_t { emergency_stop = 1, limit = 2, driver = 3 };
struct Fault {
  FaultReason reason = FaultReason::emergency_stop;
  uint16_t inputs = 0;  // bits of BoardInput: those that stopped the motors; 0: they are off again
  uint16_t event = 0;
  uint16_t executed = 0;
};

// Board to host, as an answer: more of its properties.
struct About {
  uint16_t firmware = 0;            // its own version, hundreds and units
  uint32_t highest_event_rate = 0;  // events a second, with the shortest step pulses
  uint32_t baud = 0;                // the highest baud rate of its line
  char name[16] = {};               // of the board; filled up with zeros
  uint8_t step_pulse = 0;           // the shortest step pulse, in sixteenths of a microsecond; 0: it makes none
};

// Each of these writes one frame to `frame`, which must have room for largest_frame bytes, and returns its size. Pause
// is that of Encoder.
template <class Pause = NoPause>
uint8_t encode(const Hello& hello, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::hello, sequence);
  encoder.put8(hello.version);
  encoder.put8(hello.motors);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const BoardOutputs& outputs, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::outputs, sequence);
  encoder.put8(outputs.switches);
  encoder.put16(outputs.spindle_rpm);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const HelloReply& reply, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::hello_reply, sequence);
  encoder.put8(reply.version);
  encoder.put8(reply.motors);
  encoder.put8(reply.capacity);
  encoder.put32(reply.clock);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const Session& session, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::session, sequence);
  encoder.put16(session.number);
  encoder.put8(session.silence.spindle);
  encoder.put8(session.silence.mist);
  encoder.put8(session.silence.flood);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const PinSetup& setup, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::pin_setup, sequence);
  encoder.put16(setup.inputs);
  encoder.put8(setup.steps);
  encoder.put8(setup.outputs);
  encoder.put8(setup.drivers_rest);
  encoder.put8(setup.timing.pulse);
  encoder.put8(setup.timing.set_up);
  encoder.put8(setup.timing.hold);
  encoder.put16(setup.timing.event_ticks);
  encoder.put16(setup.alarms);
  encoder.put8(setup.filter);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const Replace& replace, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::replace, sequence);
  encoder.put16(replace.after);
  encoder.put8(replace.count);
  encoder.put16(replace.sums.first);
  encoder.put16(replace.sums.second);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const Ask& ask, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::ask, sequence);
  encoder.put8(ask.version);
  encoder.put8(ask.motors);
  encoder.put8(static_cast<uint8_t>(ask.question));
  encoder.put8(ask.limit);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const Credit& credit, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::credit, sequence);
  encoder.put16(credit.executed);
  encoder.put8(credit.taken);
  encoder.put8(credit.free);
  return encoder.finish();
}

// For as many motors as the question asked for.
template <class Pause = NoPause, uint8_t room>
uint8_t encode(const BoardStatusFor<room>& status, uint8_t motors, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::status, sequence);
  encoder.put16(status.session);
  encoder.put16(status.executed);
  encoder.put8(status.taken);
  encoder.put8(status.free);
  encoder.put16(status.event);
  encoder.put8(status.state);
  encoder.put8(static_cast<uint8_t>(status.reset));
  encoder.put8(status.motors);
  encoder.put16(status.inputs);
  encoder.put8(status.answers);
  for (uint8_t motor = 0; motor < motors; ++motor) {
    encoder.put32(motor < room ? static_cast<uint32_t>(status.positions[motor]) : 0);
  }
  return encoder.finish();
}

template <class Pause = NoPause, uint8_t room>
uint8_t encode(const CapturedFor<room>& captured, uint8_t motors, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::captured, sequence);
  encoder.put16(captured.input);
  encoder.put8(captured.item);
  encoder.put16(captured.event);
  for (uint8_t motor = 0; motor < motors; ++motor) {
    encoder.put32(motor < room ? static_cast<uint32_t>(captured.positions[motor]) : 0);
  }
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const Fault& fault, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::fault, sequence);
  encoder.put8(static_cast<uint8_t>(fault.reason));
  encoder.put16(fault.inputs);
  encoder.put16(fault.event);
  encoder.put16(fault.executed);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const About& about, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::about, sequence);
  encoder.put16(about.firmware);
  encoder.put32(about.highest_event_rate);
  encoder.put32(about.baud);
  encoder.put_text(about.name, sizeof about.name);
  encoder.put8(about.step_pulse);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const Turned& turned, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::turned, sequence);
  encoder.put16(turned.progress.executed);
  encoder.put8(turned.progress.taken);
  encoder.put8(turned.progress.free);
  encoder.put16(turned.event);
  encoder.put8(turned.answers);
  encoder.put8(turned.spindle.indexes);
  encoder.put32(turned.spindle.count);
  encoder.put32(turned.spindle.tick);
  encoder.put32(turned.spindle.at_index);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const ErrorReport& error, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::error, sequence);
  encoder.put8(static_cast<uint8_t>(error.reason));
  encoder.put8(error.expected);
  return encoder.finish();
}

// The caller has checked the frame's type.
inline void decode(const WireFrame& frame, Hello& hello) {
  hello = {.version = frame.payload[0], .motors = frame.payload[1]};
}

inline void decode(const WireFrame& frame, BoardOutputs& outputs) {
  outputs = {.switches = frame.payload[0], .spindle_rpm = load16(frame.payload + 1)};
}

inline void decode(const WireFrame& frame, HelloReply& reply) {
  reply = {.version = frame.payload[0],
           .motors = frame.payload[1],
           .capacity = frame.payload[2],
           .clock = load32(frame.payload + 3)};
}

inline void decode(const WireFrame& frame, Credit& credit) {
  credit = {.executed = load16(frame.payload), .taken = frame.payload[2], .free = frame.payload[3]};
}

inline void decode(const WireFrame& frame, Turned& turned) {
  const uint8_t* bytes = frame.payload;
  decode(frame, turned.progress);
  turned.event = load16(bytes + 4);
  turned.answers = bytes[6];
  turned.spindle = {
      .count = load32(bytes + 8), .tick = load32(bytes + 12), .at_index = load32(bytes + 16), .indexes = bytes[7]};
}

inline void decode(const WireFrame& frame, Session& session) {
  session = {.number = load16(frame.payload),
             .silence = {.spindle = frame.payload[2], .mist = frame.payload[3], .flood = frame.payload[4]}};
}

inline void decode(const WireFrame& frame, PinSetup& setup) {
  setup = {.inputs = load16(frame.payload),
           .steps = frame.payload[2],
           .outputs = frame.payload[3],
           .drivers_rest = frame.payload[4],
           .timing = {.pulse = frame.payload[5],
                      .set_up = frame.payload[6],
                      .hold = frame.payload[7],
                      .event_ticks = load16(frame.payload + 8)},
           .alarms = load16(frame.payload + 10),
           .filter = frame.payload[12]};
}

inline void decode(const WireFrame& frame, Replace& replace) {
  replace = {.after = load16(frame.payload),
             .count = frame.payload[2],
             .sums = {.first = load16(frame.payload + 3), .second = load16(frame.payload + 5)}};
}

inline void decode(const WireFrame& frame, Ask& ask) {
  ask = {.version = frame.payload[0],
         .motors = frame.payload[1],
         .question = static_cast<Question>(frame.payload[2]),
         .limit = frame.payload[3]};
}

inline void load_positions(const uint8_t* bytes, uint8_t motors, int32_t* positions) {
  for (uint8_t motor = 0; motor < max_motors; ++motor, bytes += 4) {
    positions[motor] = motor < motors ? static_cast<int32_t>(load32(bytes)) : 0;
  }
}

inline void decode(const WireFrame& frame, uint8_t motors, BoardStatus& status) {
  const uint8_t* bytes = frame.payload;
  status.session = load16(bytes);
  status.executed = load16(bytes + 2);
  status.taken = bytes[4];
  status.free = bytes[5];
  status.event = load16(bytes + 6);
  status.state = bytes[8];
  status.reset = static_cast<ResetCause>(bytes[9]);
  status.motors = bytes[10];
  status.inputs = load16(bytes + 11);
  status.answers = bytes[13];
  load_positions(bytes + status_size, motors, status.positions);
}

inline void decode(const WireFrame& frame, uint8_t motors, Captured& captured) {
  captured.input = load16(frame.payload);
  captured.item = frame.payload[2];
  captured.event = load16(frame.payload + 3);
  load_positions(frame.payload + captured_size, motors, captured.positions);
}

inline void decode(const WireFrame& frame, Fault& fault) {
  fault = {.reason = static_cast<FaultReason>(frame.payload[0]),
           .inputs = load16(frame.payload + 1),
           .event = load16(frame.payload + 3),
           .executed = load16(frame.payload + 5)};
}

inline void decode(const WireFrame& frame, About& about) {
  about.firmware = load16(frame.payload);
  about.highest_event_rate = load32(frame.payload + 2);
  about.baud = load32(frame.payload + 6);
  for (uint8_t i = 0; i < sizeof about.name; ++i) about.name[i] = static_cast<char>(frame.payload[10 + i]);
  about.step_pulse = frame.payload[10 + sizeof about.name];
}

inline void decode(const WireFrame& frame, ErrorReport& error) {
  error = {.reason = static_cast<WireError>(frame.payload[0]), .expected = frame.payload[1]};
}

}  // namespace passo
