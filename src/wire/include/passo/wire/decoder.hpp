// Decoder: bytes off the wire, one at a time -> frames. Same code on the host and on the board.
//
// Invariant: a frame that arrives whole is told with its last byte, whatever came before it. Every byte costs the same
// small work, so that a board may read its line between two steps: one short way for a byte amid a payload (80 cycles
// on an AVR), another for all else.
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
  // How many motors a message has something for. Before that is agreed upon no such message is accepted.
  void set_motors(uint8_t motors) { motors_ = motors; }

  [[gnu::always_inline]] Decoded feed(uint8_t byte) {
    if (state_ != State::payload || byte == sync_byte) return feed_other(byte);
    crc_ = crc16(crc_, byte);
    // From 0 this runs round to 255, which is more than a frame has.
    if (--to_sync_ == 0) {
      to_sync_ = byte;
      byte = sync_byte;
    }
    frame_.payload[received_++] = byte;
    if (--left_ == 0) state_ = State::crc_low;
    return Decoded::pending;
  }

  // After Decoded::frame, until the next byte.
  const WireFrame& frame() const { return frame_; }

 private:
  enum class State : uint8_t { search, link, type, sequence, payload, crc_low, crc_high };

  [[gnu::noinline]] Decoded feed_other(uint8_t byte) {
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
    return head(byte);
  }

  Decoded begin() {
    const Decoded told = state_ <= State::link ? Decoded::pending : Decoded::refused;
    state_ = State::link;
    crc_ = crc16_start;
    return told;
  }

  Decoded head(uint8_t byte) {
    if (state_ == State::link) {
      to_sync_ = byte;
      state_ = State::type;
      return Decoded::pending;
    }
    if (--to_sync_ == 0) {
      to_sync_ = byte;
      byte = sync_byte;
    }
    if (state_ == State::sequence) {
      frame_.sequence = byte;
      state_ = State::payload;
      return Decoded::pending;
    }
    frame_.type = static_cast<MessageType>(byte);
    left_ = payload_size(byte, motors_);
    received_ = 0;
    state_ = left_ == 0 ? State::search : State::sequence;
    return left_ == 0 ? Decoded::refused : Decoded::pending;
  }

  Decoded check(uint8_t crc_high) {
    state_ = State::search;
    if (crc_ == static_cast<uint16_t>(crc_low_ | crc_high << 8)) {
      if (crc_high == sync_byte) begin();
      return Decoded::frame;
    }
    // Where a frame was cut short, the next one's sync byte may have come in the place of the CRC. (Above, it may even
    // have been the right last byte.) There is no payload under way, so neither goes the short way.
    feed_other(crc_low_);
    feed_other(crc_high);
    return Decoded::refused;
  }

  WireFrame frame_;
  State state_ = State::search;
  uint8_t motors_ = 0;
  uint8_t to_sync_ = 0;   // bytes until the next one that stands for a sync byte
  uint8_t received_ = 0;  // bytes of the payload
  uint8_t left_ = 0;
  uint8_t crc_low_ = 0;
  uint16_t crc_ = 0;
};

}  // namespace passo
