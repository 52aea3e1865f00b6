// Encoder: builds one frame in a buffer of the caller. Host and board use the same code.
//
// Building a frame takes long on a chip that must also read its link. So Pause{}() is called at every byte; on the host
// it does nothing. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/crc16.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

struct NoPause {
  void operator()() const {}
};

template <class Pause = NoPause>
class Encoder {
 public:
  // `frame` must have room for largest_frame bytes.
  Encoder(uint8_t* frame, MessageType type, uint8_t sequence) : frame_(frame) {
    frame_[0] = sync_byte;
    frame_[1] = 0;
    put8(static_cast<uint8_t>(type));
    put8(sequence);
  }

  void put8(uint8_t byte) {
    if (byte == sync_byte) {
      frame_[last_link_] = static_cast<uint8_t>(size_ - last_link_);
      last_link_ = size_;
      byte = 0;
    }
    frame_[size_++] = byte;
    Pause{}();
  }
  // Least significant byte first.
  void put16(uint16_t value) {
    put8(static_cast<uint8_t>(value));
    put8(static_cast<uint8_t>(value >> 8));
  }
  void put24(uint32_t value) {
    put16(static_cast<uint16_t>(value));
    put8(static_cast<uint8_t>(value >> 16));
  }
  void put32(uint32_t value) {
    // Not with put16(), because a chip's stack is small.
    for (uint8_t left = 4; left != 0; --left, value >>= 8) put8(static_cast<uint8_t>(value));
  }

  // A loop keeps the code small; clang would unroll it.
  void put_text(const char* text, uint8_t size) {
#ifdef __clang__
#pragma clang loop unroll(disable)
#endif
    for (; size != 0; --size) put8(static_cast<uint8_t>(*text++));
  }

  // Closes the frame and returns its size. Call it once.
  uint8_t finish() {
    // The CRC covers the bytes as they are sent, including links, so that a flipped bit is exactly one wrong bit for
    // the CRC.
    uint16_t crc = crc16_start;
    for (uint8_t i = 1; i < size_; ++i) {
      crc = crc16(crc, frame_[i]);
      Pause{}();
    }
    frame_[size_++] = static_cast<uint8_t>(crc);
    frame_[size_++] = static_cast<uint8_t>(crc >> 8);
    return size_;
  }

 private:
  uint8_t* frame_;
  uint8_t size_ = 2;
  uint8_t last_link_ = 1;  // where to write the distance to the next sync byte
};

}  // namespace passo
