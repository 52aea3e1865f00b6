// Decoder: bytes off the wire, one at a time -> frames. Same code on the host and on the board.
//
// Invariant: a frame that arrives whole is told with its last byte, whatever came before it. Every byte costs the same
// small work, so that a board may read its line between two steps.
//
// Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/crc16.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

enum class Decoded : uint8_t {
  pending,  // nothing to tell yet
  frame,    // frame() is whole and right
  refused,  // what looked like a frame was none: cut short, of no known type, or its CRC is wrong
};

class Decoder {
 public:
  // How many increments a segment has. Before that is agreed upon no segment is accepted.
  void set_motors(uint8_t motors) { motors_ = motors; }

  Decoded feed(uint8_t byte) {
    // The two bytes of the CRC are the only ones after the sync byte that may look like one.
    if (state_ == State::crc_low) {
      crc_low_ = byte;
      state_ = State::crc_high;
      return Decoded::pending;
    }
    if (state_ == State::crc_high) return check(byte);
    if (byte == sync_byte) return begin();
    if (state_ == State::search) return Decoded::pending;
    crc_ = crc16(crc_, byte);
    return body(byte);
  }

  // After Decoded::frame, until the next byte.
  const WireFrame& frame() const { return frame_; }

 private:
  enum class State : uint8_t { search, link, type, sequence, payload, crc_low, crc_high };

  Decoded begin() {
    const Decoded told = state_ <= State::link ? Decoded::pending : Decoded::refused;
    state_ = State::link;
    crc_ = crc16_start;
    return told;
  }

  Decoded body(uint8_t byte) {
    if (state_ == State::link) {
      to_sync_ = byte;
      state_ = State::type;
      return Decoded::pending;
    }
    // From 0 this runs round to 255, which is more than a frame has.
    if (--to_sync_ == 0) {
      to_sync_ = byte;
      byte = sync_byte;
    }
    if (state_ == State::payload) {
      frame_.payload[received_++] = byte;
      if (received_ == size_) state_ = State::crc_low;
    } else if (state_ == State::type) {
      frame_.type = static_cast<MessageType>(byte);
      size_ = payload_size(byte, motors_);
      received_ = 0;
      state_ = size_ == 0 ? State::search : State::sequence;
      if (size_ == 0) return Decoded::refused;
    } else {
      frame_.sequence = byte;
      state_ = State::payload;
    }
    return Decoded::pending;
  }

  Decoded check(uint8_t crc_high) {
    state_ = State::search;
    if (crc_ == static_cast<uint16_t>(crc_low_ | crc_high << 8)) {
      if (crc_high == sync_byte) begin();
      return Decoded::frame;
    }
    // Where a frame was cut short, the next one's sync byte may have come in the place of the CRC. (Above, it may even
    // have been the right last byte.)
    feed(crc_low_);
    feed(crc_high);
    return Decoded::refused;
  }

  WireFrame frame_;
  State state_ = State::search;
  uint8_t motors_ = 0;
  uint8_t to_sync_ = 0;  // bytes until the next one that stands for a sync byte
  uint8_t size_ = 0;     // of the payload
  uint8_t received_ = 0;
  uint8_t crc_low_ = 0;
  uint16_t crc_ = 0;
};

}  // namespace passo
