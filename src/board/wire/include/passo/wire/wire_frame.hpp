// WireFrame: the frame of every message, in both directions. docs/wire.md describes it byte by byte.
//
//   sync  link  type  sequence  payload…  crc low  crc high
//
// The sync byte never occurs from link to payload. A message byte with that value is replaced by the distance to the
// next such byte (0: none); `link` is the distance to the first. A sync byte therefore always starts a frame. After
// garbage, a receiver is synchronised again at the next frame, and each byte takes the same time. The type determines
// the length; for messages with a value for each motor, the type and the number of motors do. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"

namespace passo {

inline constexpr uint8_t sync_byte = 0xA5;
inline constexpr uint8_t protocol_version = 10;

// Words of the extended Hamming code (8,4): only four or more wrong bits can turn one type into another.
enum class MessageType : uint8_t {
  // host to board
  hello = 0x0F,
  segment = 0x33,
  outputs = 0x3C,
  replace = 0x55,
  session = 0x66,
  ask = 0x5A,
  // board to host
  hello_reply = 0xF0,
  credit = 0xCC,
  error = 0xC3,
  status = 0xAA,
  captured = 0x99,
  fault = 0x96,
  about = 0x69,
  turned = 0xFF,
  // both directions
  pin_setup = 0x00,
};

inline constexpr uint8_t frame_overhead = 6;
inline constexpr uint8_t segment_size =
    11;  // without the part that is repeated for each motor, and with the bend in the flips byte
// Up to this number of motors, the bend is in the upper half of the flips byte.
inline constexpr uint8_t most_motors_beside_bend = 4;
inline constexpr uint8_t status_size = 14;
inline constexpr uint8_t captured_size = 5;
inline constexpr uint8_t largest_payload = status_size + 4 * max_motors;
inline constexpr uint8_t largest_frame = frame_overhead + largest_payload;

struct WireFrame {
  MessageType type = MessageType::hello;
  uint8_t sequence = 0;
  uint8_t payload[largest_payload];  // used as far as the type needs
};

// The payload size in bytes; 0 for an unknown type. With 0 motors, messages with a value for each motor are unknown
// too.
constexpr uint8_t payload_size(uint8_t type, uint8_t motors) {
  const auto with_motors = [motors](unsigned rest, unsigned each) {
    return motors == 0 ? uint8_t{0} : static_cast<uint8_t>(rest + each * motors);
  };
  switch (static_cast<MessageType>(type)) {
    case MessageType::hello:
    case MessageType::error: return 2;
    case MessageType::outputs: return 3;
    case MessageType::ask:
    case MessageType::credit: return 4;
    case MessageType::session: return 5;
    case MessageType::fault:
    case MessageType::replace:
    case MessageType::hello_reply: return 7;
    case MessageType::pin_setup: return 13;
    case MessageType::turned: return 20;
    case MessageType::about: return 27;
    case MessageType::segment:
      return with_motors(motors > most_motors_beside_bend ? segment_size + 1U : segment_size, 2);
    case MessageType::status: return with_motors(status_size, 4);
    case MessageType::captured: return with_motors(captured_size, 4);
  }
  return 0;
}

}  // namespace passo
