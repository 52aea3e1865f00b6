// Decoder: assembles frames from received bytes, one byte at a time. Host and board use the same code.
//
// Invariant: a complete frame is reported with its last byte, whatever came before it. Every byte costs the same small
// time, so that a board can read its link between two steps. Bytes inside a payload take a fast path (on an AVR about
// 60 cycles for a run of them and 48 for each).
//
// Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/crc16.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

enum class Decoded : uint8_t {
  pending,  // nothing to report yet
  frame,    // frame() is complete and correct
  refused,  // the bytes were not a valid frame: truncated, of unknown type, or with a wrong CRC
};

class Decoder {
 public:
  // Sets the number of motors in messages with a value for each motor. Until then, no such message is accepted.
  void set_motors(uint8_t motors) { motors_ = motors; }

  Decoded feed(uint8_t byte) { return feed_payload(&byte, 1) == 1 ? Decoded::pending : feed_other(byte); }
  // Processes the payload bytes among the next `count` bytes, up to the end of the payload. Returns their number; 0 if
  // the first byte is for feed_other().
  [[gnu::always_inline]] uint8_t feed_payload(const uint8_t* bytes, uint8_t count) {
    if (state_ != State::payload) return 0;
    if (count > left_) count = left_;
    uint16_t crc = crc_;
    uint8_t to_sync = to_sync_;
    uint8_t* to = frame_.payload + received_;
    uint8_t left = count;
    for (; left != 0; --left) {
      uint8_t byte = *bytes++;
      if (byte == sync_byte) break;
      crc = crc16(crc, byte);
      // From 0 this wraps to 255, which is more bytes than a frame has.
      if (--to_sync == 0) {
        to_sync = byte;
        byte = sync_byte;
      }
      *to++ = byte;
    }
    const uint8_t taken = static_cast<uint8_t>(count - left);
    crc_ = crc;
    to_sync_ = to_sync;
    received_ = static_cast<uint8_t>(received_ + taken);
    left_ = static_cast<uint8_t>(left_ - taken);
    if (left_ == 0) state_ = State::crc_low;
    return taken;
  }

  // Processes a byte outside a payload.
  [[gnu::noinline]] Decoded feed_other(uint8_t byte) {
    // After the sync byte only the two bytes of the CRC may have the value of a sync byte.
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

  // The frame after Decoded::frame. Valid until the next byte.
  const WireFrame& frame() const { return frame_; }

 private:
  enum class State : uint8_t { search, link, type, sequence, payload, crc_low, crc_high };

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
    // If a frame was truncated, the next frame's sync byte may be at the position of the CRC. (The check above may even
    // have taken it for the correct last byte.) Neither byte is inside a payload, so neither takes the fast path.
    feed_other(crc_low_);
    feed_other(crc_high);
    return Decoded::refused;
  }

  WireFrame frame_;
  State state_ = State::search;
  uint8_t motors_ = 0;
  uint8_t to_sync_ = 0;   // bytes until the next one that replaces a sync byte
  uint8_t received_ = 0;  // bytes of the payload
  uint8_t left_ = 0;
  uint8_t crc_low_ = 0;
  uint16_t crc_ = 0;
};

}  // namespace passo
