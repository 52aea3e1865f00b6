// Messages: what is in the frames, and how it lies there. docs/wire.md has each of them byte by byte. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"
#include "passo/wire/item_sums.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

// Host to board, first of all. Its sequence number is where the counting starts: the first frame has the next one.
struct Hello {
  uint8_t version = protocol_version;
  uint8_t motors = 0;  // how many increments each segment will have
};

// The board's answer: what it is.
struct HelloReply {
  uint8_t version = protocol_version;
  uint8_t motors = 0;    // the most it can turn
  uint8_t capacity = 0;  // items that it holds, the one being played included
  uint32_t clock = 0;    // ticks a second
};

// Host to board, behind a hello: a number by which the host knows the board again after the line was broken. A board
// that was reset meanwhile has none, 0.
struct Session {
  uint16_t number = 0;
};

// Host to board: the `count` frames that follow are items that take the place of all that the board holds behind item
// `after`, as soon as the last of them has come.
struct Replace {
  uint16_t after = 0;
  uint8_t count = 0;   // 1 and more
  ItemSums sums = {};  // to which all of it is added: nothing must be left
};

// Host to board, at any time: how are you? The only message of the host's, with hello and session, that is not counted.
// Its sequence number is a number of its own, by which the status says which question it answers.
enum class Question : uint8_t {
  status = 0,
  about = 1,
  watch = 2,    // and keep from now on where the probe, or the limit switch that is named, changes first; the answer is
                // the status
  kept = 3,     // what was kept: the answer is a captured
  spindle = 8,  // where is it: the answer is a turned, of a board without an encoder the status
};
struct Ask {
  uint8_t version = protocol_version;
  uint8_t motors = 0;  // for how many positions are wanted
  Question question = Question::status;
  uint8_t limit = 0;  // of a watch: the bit of a limit switch that is to capture in place of stopping; 0: the probe is
};

// Board to host: so far have I come. Each tells all that the ones before it told, so that none is missed when lost.
struct Credit {
  uint16_t executed = 0;  // number of the last item that is done
  uint8_t taken = 0;      // sequence number of the last frame that was taken
  uint8_t free = 0;       // items that there is room for
};

enum class WireError : uint8_t {
  bad_frame = 1,        // cut short, of no known type, or the CRC is wrong
  out_of_sequence = 2,  // a frame is missing before this one
  queue_full = 3,       // the host did not count its credits
  bad_value = 4,        // a segment without events, faster than the board is, or for a motor that is not there
  unexpected = 5,       // a message that only the board sends, or a hello amid motion
  too_late = 6,         // an item behind the one to replace after has begun; what was to take its place is dropped
  manual = 7,           // a person moves the machine, or has since the hello: say it again behind that
  wrong_sums = 8,       // items came that were not sent: what was to take the place of others is dropped
};

// Board to host: what came was not taken.
struct ErrorReport {
  WireError reason = WireError::bad_frame;
  uint8_t expected = 0;  // sequence number of the frame that the board waits for
};

enum class ResetCause : uint8_t { power_on = 0, brown_out = 1, watchdog = 2, button = 3 };
enum BoardState : uint8_t {
  board_moves = 1,      // it plays something
  board_trusted = 2,    // since the hello the motors have made every step that is counted, as far as the board knows
  board_replaces = 4,   // items are still to come for a replacement
  board_slipped = 8,    // since the hello it stood still amid motion: it could not make events in time. No step is lost
  board_kept = 16,      // since it was told to watch, the probe has changed
  board_manual = 32,    // a person moves the machine by the board's keypad
  board_homes = 64,     // a limit switch captures in place of stopping
  board_encodes = 128,  // it has an encoder at its spindle
};
// What the board's input pins say: a bit is set where the switch is on.
enum BoardInput : uint16_t {
  input_limit = 1,  // and the next seven: of motors 1…7
  input_probe = 0x100,
  input_door = 0x200,
  input_emergency_stop = 0x400,
  input_hold = 0x800,
  input_start = 0x1000,
};
// Beside the input of a captured.
inline constexpr uint16_t captured_kept = 0x4000;      // it answers a question
inline constexpr uint16_t captured_released = 0x8000;  // the input has gone off

// Board to host, when asked. Positions are the motors' steps since the board was switched on.
// `room`: for so many motors it has places.
template <uint8_t room>
struct BoardStatusFor {
  uint16_t session = 0;
  uint16_t executed = 0;  // as in a credit, as the next two
  uint8_t taken = 0;
  uint8_t free = 0;
  uint16_t event = 0;  // how many events of the item at hand are played
  uint8_t state = 0;   // bits: BoardState
  ResetCause reset = ResetCause::power_on;
  uint8_t motors = 0;   // agreed upon; 0: a host has not said hello since the reset
  uint16_t inputs = 0;  // bits: BoardInput
  uint8_t answers = 0;  // sequence number of the question
  int32_t positions[room] = {};
};
using BoardStatus = BoardStatusFor<max_motors>;

// Board to host: an input has changed that is watched, at this very event. As an answer: where the probe changed first;
// without an input it did not, and there is no item.
struct Captured {
  uint16_t input = 0;  // BoardInput, captured_kept, captured_released
  uint8_t item = 0;    // low byte of the number of the item that was played
  uint16_t event = 0;  // how many of its events were
  int32_t positions[max_motors] = {};
};

// What a board's encoder has counted, and when: counts and ticks run on from any start, modulo 2^32.
struct SpindleCount {
  uint32_t count = 0;
  uint32_t tick = 0;      // of the board's clock, when it was that
  uint32_t at_index = 0;  // the count at the last index
  uint8_t indexes = 0;    // how many have come, modulo 256
};

// Board to host, when asked for it: how far the spindle is, and at that tick the motion. It tells all that a credit
// does.
struct Turned {
  Credit progress = {};
  uint16_t event = 0;   // how many events of the item at hand were played
  uint8_t answers = 0;  // sequence number of the question
  SpindleCount spindle = {};
};

// Board to host: the motors were stopped at once. The positions are not trusted from here on; a hello begins anew.
enum class FaultReason : uint8_t { emergency_stop = 1, limit = 2, driver = 3 };
struct Fault {
  FaultReason reason = FaultReason::emergency_stop;
  uint16_t event = 0;
  uint16_t executed = 0;
};

// Board to host, when asked: what else it is.
struct About {
  uint16_t firmware = 0;            // its own version, hundreds and units
  uint32_t highest_event_rate = 0;  // events a second
  uint32_t baud = 0;                // the fastest that its line can go
  char name[16] = {};               // of the board; filled up with zeros
};

// Each writes one frame to `frame`, which has room for largest_frame bytes, and returns its size. Pause: Encoder's.
template <class Pause = NoPause>
uint8_t encode(const Hello& hello, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::hello, sequence);
  encoder.put8(hello.version);
  encoder.put8(hello.motors);
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const BoardSegment& segment, uint8_t motors, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::segment, sequence);
  const bool fine = is_fine(segment.change);
  encoder.put16(fine ? segment.events : static_cast<uint16_t>(segment.events | coarse_bit));
  encoder.put8(segment.directions);
  encoder.put8(segment.flips);
  encoder.put32(segment.interval);
  encoder.put24(static_cast<uint32_t>(fine ? segment.change : segment.change / coarse_change));
  for (uint8_t motor = 0; motor < motors; ++motor) encoder.put16(segment.increments[motor]);
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

// For as many motors as the question had.
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

template <class Pause = NoPause>
uint8_t encode(const Captured& captured, uint8_t motors, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::captured, sequence);
  encoder.put16(captured.input);
  encoder.put8(captured.item);
  encoder.put16(captured.event);
  for (uint8_t motor = 0; motor < motors; ++motor) encoder.put32(static_cast<uint32_t>(captured.positions[motor]));
  return encoder.finish();
}

template <class Pause = NoPause>
uint8_t encode(const Fault& fault, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::fault, sequence);
  encoder.put8(static_cast<uint8_t>(fault.reason));
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
  for (const char letter : about.name) encoder.put8(static_cast<uint8_t>(letter));
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

constexpr uint16_t load16(const uint8_t* bytes) {
  return static_cast<uint16_t>(bytes[0] | bytes[1] << 8);
}
constexpr uint32_t load32(const uint8_t* bytes) {
  return load16(bytes) | static_cast<uint32_t>(load16(bytes + 2)) << 16;
}

// The caller has looked at the frame's type.
inline void decode(const WireFrame& frame, Hello& hello) {
  hello = {.version = frame.payload[0], .motors = frame.payload[1]};
}

// By themselves, for the sake of the registers that they need on a chip.
template <uint8_t room>
[[gnu::noinline]] void load_increments(const uint8_t* bytes, uint8_t motors, SegmentFor<room>& segment) {
  for (uint8_t motor = 0; motor < room; ++motor, bytes += 2) {
    segment.increments[motor] = motor < motors ? load16(bytes) : uint16_t{0};
  }
}

template <uint8_t room>
[[gnu::noinline]] void load_times(const uint8_t* bytes, bool coarse, SegmentFor<room>& segment) {
  segment.interval = load32(bytes);
  // 24 bits with a sign: at the top they are a large one, and a small one down again with the sign drawn along.
  segment.change =
      static_cast<int32_t>(static_cast<uint32_t>(load16(bytes + 4)) << 8 | static_cast<uint32_t>(bytes[6]) << 24);
  if (!coarse) segment.change >>= 8;
}

// `motors` is at most `room`.
template <uint8_t room>
void decode(const WireFrame& frame, uint8_t motors, SegmentFor<room>& segment) {
  const uint8_t* bytes = frame.payload;
  const uint16_t events = load16(bytes);
  segment.events = events & most_events;
  segment.directions = bytes[2];
  segment.flips = bytes[3];
  load_times(bytes + 4, (events & coarse_bit) != 0, segment);
  load_increments(bytes + segment_size, motors, segment);
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
  session = {.number = load16(frame.payload)};
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
           .event = load16(frame.payload + 1),
           .executed = load16(frame.payload + 3)};
}

inline void decode(const WireFrame& frame, About& about) {
  about.firmware = load16(frame.payload);
  about.highest_event_rate = load32(frame.payload + 2);
  about.baud = load32(frame.payload + 6);
  for (uint8_t i = 0; i < sizeof about.name; ++i) about.name[i] = static_cast<char>(frame.payload[10 + i]);
}

inline void decode(const WireFrame& frame, ErrorReport& error) {
  error = {.reason = static_cast<WireError>(frame.payload[0]), .expected = frame.payload[1]};
}

}  // namespace passo
