// Messages: the contents of frames and their layout. docs/wire.md describes each message byte by byte. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"
#include "passo/wire/item_sums.hpp"
#include "passo/wire/segment_message.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

// Host to board, the first message of the handshake. Its sequence number starts the numbering: the first frame has the
// next number.
struct Hello {
  uint8_t version = protocol_version;
  uint8_t motors = 0;  // the number of increments of each segment
};

// The board's answer: its properties.
struct HelloReply {
  uint8_t version = protocol_version;
  uint8_t motors = 0;    // the largest number of motors
  uint8_t capacity = 0;  // length of the queue, including the item being executed
  uint32_t clock = 0;    // timer frequency, Hz
};

// The silence of the host after which a stopped board switches an output off, in tenths of a second; 0: never.
struct Silence {
  uint8_t spindle = 0;
  uint8_t mist = 0;
  uint8_t flood = 0;
};

// Host to board, after a hello. By this number the host recognises the board after an interruption of the link. A board
// that was reset has the number 0.
struct Session {
  uint16_t number = 0;
  Silence silence = {};
};

// The timing of the step and direction pins, in sixteenths of a microsecond. The host sends the shortest times that the
// drivers need, and the board answers with its actual times. Longer times may reduce the board's event rate.
struct StepTiming {
  uint8_t pulse = 0;         // how long a step pulse lasts
  uint8_t set_up = 0;        // from a change of the direction to the edge that starts a step
  uint8_t hold = 0;          // from the edge that starts a step to a change of the direction
  uint16_t event_ticks = 0;  // the shortest interval between events in clock ticks; 0: no limit

  friend constexpr bool operator==(const StepTiming& a, const StepTiming& b) {
    return a.pulse == b.pulse && a.set_up == b.set_up && a.hold == b.hold && a.event_ticks == b.event_ticks;
  }
};

// Host to board, before a hello: the pin set-up. It is valid until a hello without one. Board to host, as the answer:
// the set-up of the board, without unsupported parts.
//
// By default, inputs are active low, outputs active high, and the drivers' enable active low. A set bit means the
// opposite.
struct PinSetup {
  uint16_t inputs = 0;       // bits: BoardInput
  uint8_t steps = 0;         // bit m: the step pin of motor m
  uint8_t outputs = 0;       // bits: OutputSwitch, and inverted_enable
  uint8_t drivers_rest = 0;  // tenths of a second without host and motion until the drivers are switched off; 0: never
  StepTiming timing = {};
  uint16_t alarms = 0;  // bits of BoardInput: inputs that are drive alarms, which stop the motors
  uint8_t filter = 0;   // filter time of the switches in microseconds

  friend constexpr bool operator==(const PinSetup& a, const PinSetup& b) {
    return a.inputs == b.inputs && a.steps == b.steps && a.outputs == b.outputs && a.drivers_rest == b.drivers_rest &&
           a.timing == b.timing && a.alarms == b.alarms && a.filter == b.filter;
  }
};
inline constexpr uint8_t inverted_enable = 0x10;

// Host to board: a queue update. The next `count` frames are items, which replace the board's queue after item `after`
// as soon as the last of them has arrived.
struct Replace {
  uint16_t after = 0;
  uint8_t count = 0;   // at least 1
  ItemSums sums = {};  // all words are added to them; the result must be 0
};

// Host to board, at any time: a query of the board's state. Like hello and session, it is not numbered with the frames.
// It has a separate sequence number, which the answer repeats.
enum class Question : uint8_t {
  status = 0,
  about = 1,
  watch = 2,  // capture the position of the first change of the probe or the given limit switch; the answer is a status
              // message
  kept = 3,   // read the captured positions; the answer is a Captured message
  spindle = 8,    // read the spindle's angle; the answer is a Turned message, or a status if the board has no encoder
  handwheel = 9,  // read the handwheel at the board's pins; the answer is a Turned message (HandwheelCount), or a
                  // status if the board has none
};
struct Ask {
  uint8_t version = protocol_version;
  uint8_t motors = 0;  // the number of requested positions
  Question question = Question::status;
  uint8_t limit =
      0;  // for watch: the bit of the limit switch that captures instead of stopping the motors; 0: the probe
};

// Board to host: progress. Each credit includes all earlier ones, so losing one does no harm.
struct Credit {
  uint16_t executed = 0;  // number of the last executed item
  uint8_t taken = 0;      // sequence number of the last accepted frame
  uint8_t free = 0;       // free places for items
};

enum class WireError : uint8_t {
  bad_frame = 1,        // truncated, of unknown type, or with a wrong CRC
  out_of_sequence = 2,  // a previous frame is missing
  queue_full = 3,       // the host ignored its credits
  bad_value = 4,        // a segment without events, faster than the board, or for a motor that does not exist
  unexpected = 5,       // a message that only the board sends, or a hello during motion
  too_late = 6,         // the queue update came too late: a later item has already started, so the update is dropped
  manual = 7,       // the machine is, or was since the hello, moved with the keypad: a new hello is needed afterwards
  wrong_sums = 8,   // the received items differ from the sent ones: the queue update is dropped
  silent_host = 9,  // the outputs are off after a silence of the host: send outputs first; the queue update is dropped
};

// Board to host: a frame was rejected.
struct ErrorReport {
  WireError reason = WireError::bad_frame;
  uint8_t expected = 0;  // sequence number of the frame that the board expects
};

enum class ResetCause : uint8_t { power_on = 0, brown_out = 1, watchdog = 2, button = 3 };
enum BoardState : uint8_t {
  board_moves = 1,     // the board executes motion
  board_trusted = 2,   // since the hello no counted step was lost, as far as the board knows
  board_replaces = 4,  // a queue update still waits for items
  board_slipped =
      8,  // since the hello the board could not make events in time, and stopped during motion; its counts are correct
  board_kept = 16,      // the watched input has changed since the watch began
  board_manual = 32,    // the machine is moved with the board's keypad
  board_homes = 64,     // a limit switch captures instead of stopping the motors
  board_encodes = 128,  // the spindle has an encoder
};
// The board's input pins. A set bit means active.
enum BoardInput : uint16_t {
  input_limit = 1,  // motor 0; the next seven bits are motors 1…7
  input_probe = 0x100,
  input_door = 0x200,
  input_emergency_stop = 0x400,
  input_hold = 0x800,
  input_start = 0x1000,
};
// A further bit in the inputs of a status: outputs are off after a silence of the host, and no motion is accepted
// before outputs.
inline constexpr uint16_t outputs_timed_out = 0x2000;
// Another one: the drivers are off after a silence of the host, so the position is not trusted.
inline constexpr uint16_t drivers_timed_out = 0x4000;
// Further bits in the input of a Captured message.
inline constexpr uint16_t captured_kept = 0x4000;      // this is the answer to a query
inline constexpr uint16_t captured_released = 0x8000;  // the input became inactive

// Board to host, as an answer. Positions are the motors' steps since power-on. `room` is the number of motors for which
// there is space.
template <uint8_t room>
struct BoardStatusFor {
  uint16_t session = 0;
  uint16_t executed = 0;  // this and the next two members as in a credit
  uint8_t taken = 0;
  uint8_t free = 0;
  uint16_t event = 0;  // executed events of the present item
  uint8_t state = 0;   // bits: BoardState
  ResetCause reset = ResetCause::power_on;
  uint8_t motors = 0;   // agreed with the host; 0: no hello since the reset
  uint16_t inputs = 0;  // bits: BoardInput
  uint8_t answers = 0;  // sequence number of the answered query
  int32_t positions[room] = {};
};
using BoardStatus = BoardStatusFor<max_motors>;

// Board to host: a watched input changed at this event. As an answer: the first change of the watched input; without an
// input, there was no change.
template <uint8_t room>
struct CapturedFor {
  uint16_t input = 0;  // BoardInput, captured_kept, captured_released
  uint8_t item = 0;    // low byte of the number of the executed item
  uint16_t event = 0;  // executed events of that item
  int32_t positions[room] = {};
};
using Captured = CapturedFor<max_motors>;

// A count of the spindle's encoder, and its time. Counts and ticks have arbitrary origins, and wrap modulo 2^32.
struct SpindleCount {
  uint32_t count = 0;
  uint32_t tick = 0;      // the board's clock at the count
  uint32_t at_index = 0;  // the count at the last index
  uint8_t indexes = 0;    // index pulses so far, modulo 256
};

// Board to host, as an answer: the spindle's angle, and the position in the motion at the same tick. It includes a
// credit.
struct Turned {
  Credit progress = {};
  uint16_t event = 0;   // executed events of the present item
  uint8_t answers = 0;  // sequence number of the answered query
  SpindleCount spindle = {};
};

// Board to host: the motors were stopped instantly. Positions are unreliable until the next hello.
enum class FaultReason : uint8_t { emergency_stop = 1, limit = 2, driver = 3 };
struct Fault {
  FaultReason reason = FaultReason::emergency_stop;
  uint16_t inputs = 0;  // bits of BoardInput: those that stopped the motors; 0: they are inactive again
  uint16_t event = 0;
  uint16_t executed = 0;
};

// Board to host, as an answer: further properties.
struct About {
  uint16_t firmware = 0;            // firmware version, hundreds and units
  uint32_t highest_event_rate = 0;  // events/s with the shortest step pulses
  uint32_t baud = 0;                // the highest baud rate of its serial link
  char name[16] = {};               // name of the board, padded with zeros
  uint8_t step_pulse = 0;           // the shortest step pulse, in sixteenths of a microsecond; 0: no step pulses
};

// Each of these functions writes one frame to `frame`, which must have space for largest_frame bytes, and returns its
// size. Pause as in Encoder.
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

// With the number of positions that the query requested.
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
