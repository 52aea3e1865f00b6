// Messages: what is in the frames, and how it lies there. docs/wire.md has each of them byte by byte. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"
#include "passo/wire/probe.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

// Host to board, first of all. Its sequence number is where the counting starts: the first item has the next one.
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

// Board to host: so far have I come. Each tells all that the ones before it told, so that none is missed when lost.
struct Credit {
  uint8_t executed = 0;  // sequence number of the last item that is done
  uint8_t free = 0;      // items that the queue has room for
};

enum class WireError : uint8_t {
  bad_frame = 1,        // cut short, of no known type, or the CRC is wrong
  out_of_sequence = 2,  // an item is missing before this one
  queue_full = 3,       // the host did not count its credits
  bad_value = 4,        // a segment without events, or for a motor that is not there
  unexpected = 5,       // a message that only the board sends, or a hello amid motion
};

// Board to host: what came was not taken.
struct ErrorReport {
  WireError reason = WireError::bad_frame;
  uint8_t expected = 0;  // sequence number of the item that the board waits for
};

// Each writes one frame to `frame`, which has room for largest_frame bytes, and returns its size.
inline uint8_t encode(const Hello& hello, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::hello, sequence);
  encoder.put8(hello.version);
  encoder.put8(hello.motors);
  return encoder.finish();
}

// The change fits in 24 bits: at most largest_change, up or down.
inline uint8_t encode(const BoardSegment& segment, uint8_t motors, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::segment, sequence);
  encoder.put8(segment.events);
  encoder.put8(segment.directions);
  encoder.put8(segment.flips);
  encoder.put32(segment.interval);
  encoder.put24(static_cast<uint32_t>(segment.change));
  for (uint8_t motor = 0; motor < motors; ++motor) encoder.put16(segment.increments[motor]);
  return encoder.finish();
}

inline uint8_t encode(const BoardOutputs& outputs, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::outputs, sequence);
  encoder.put8(outputs.switches);
  encoder.put16(outputs.spindle_rpm);
  return encoder.finish();
}

inline uint8_t encode(const ProbeWatch& watch, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::watch_probe, sequence);
  encoder.put8(static_cast<uint8_t>(watch.until));
  return encoder.finish();
}

inline uint8_t encode(const HelloReply& reply, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::hello_reply, sequence);
  encoder.put8(reply.version);
  encoder.put8(reply.motors);
  encoder.put8(reply.capacity);
  encoder.put32(reply.clock);
  return encoder.finish();
}

inline uint8_t encode(const Credit& credit, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::credit, sequence);
  encoder.put8(credit.executed);
  encoder.put8(credit.free);
  return encoder.finish();
}

inline uint8_t encode(const ErrorReport& error, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::error, sequence);
  encoder.put8(static_cast<uint8_t>(error.reason));
  encoder.put8(error.expected);
  return encoder.finish();
}

inline uint8_t encode(const ProbeReport& report, uint8_t motors, uint8_t sequence, uint8_t* frame) {
  Encoder encoder(frame, MessageType::probe_report, sequence);
  encoder.put8(static_cast<uint8_t>((report.touched ? 1 : 0) | (report.happened ? 2 : 0)));
  for (uint8_t motor = 0; motor < motors; ++motor) encoder.put32(static_cast<uint32_t>(report.steps[motor]));
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

inline void decode(const WireFrame& frame, uint8_t motors, BoardSegment& segment) {
  const uint8_t* bytes = frame.payload;
  segment.events = bytes[0];
  segment.directions = bytes[1];
  segment.flips = bytes[2];
  segment.interval = load32(bytes + 3);
  // 24 bits with a sign: up to the top, and down again with the sign drawn along.
  segment.change =
      static_cast<int32_t>(static_cast<uint32_t>(load16(bytes + 7)) << 8 | static_cast<uint32_t>(bytes[9]) << 24) >> 8;
  bytes += 10;
  for (uint8_t motor = 0; motor < max_motors; ++motor, bytes += 2) {
    segment.increments[motor] = motor < motors ? load16(bytes) : uint16_t{0};
  }
}

inline void decode(const WireFrame& frame, BoardOutputs& outputs) {
  outputs = {.switches = frame.payload[0], .spindle_rpm = load16(frame.payload + 1)};
}

inline void decode(const WireFrame& frame, ProbeWatch& watch) {
  watch = {.until = static_cast<ProbeUntil>(frame.payload[0])};
}

inline void decode(const WireFrame& frame, HelloReply& reply) {
  reply = {.version = frame.payload[0],
           .motors = frame.payload[1],
           .capacity = frame.payload[2],
           .clock = load32(frame.payload + 3)};
}

inline void decode(const WireFrame& frame, Credit& credit) {
  credit = {.executed = frame.payload[0], .free = frame.payload[1]};
}

inline void decode(const WireFrame& frame, ErrorReport& error) {
  error = {.reason = static_cast<WireError>(frame.payload[0]), .expected = frame.payload[1]};
}

inline void decode(const WireFrame& frame, uint8_t motors, ProbeReport& report) {
  report = {.touched = (frame.payload[0] & 1U) != 0, .happened = (frame.payload[0] & 2U) != 0};
  for (uint8_t motor = 0; motor < motors; ++motor) {
    report.steps[motor] = static_cast<int32_t>(load32(frame.payload + 1 + 4 * motor));
  }
}

}  // namespace passo
