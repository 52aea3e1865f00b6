// ItemSums: a second check over everything that moves motors. Host and board use the same code.
//
// A byte that is lost or doubled shifts a frame, and a CRC of 16 bits lets one such frame in 65,536 pass. So a replace
// carries two sums. Everything that it announces is added to them, word by word. The host has chosen the sums so that
// both are 0 in the end. The first is the sum of all words; the second is the sum of all values of the first
// (Fletcher's check, modulo 65,536). Its arithmetic is of another kind than the CRC's, so that an error that deceives
// one does not deceive the other. On an AVR it takes about 20 cycles a word, where a second CRC of 16 bits would take
// about 50.
//
// Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/encoder.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

struct ItemSums {
  uint16_t first = 0;
  uint16_t second = 0;

  void add(uint16_t word) {
    first = static_cast<uint16_t>(first + word);
    second = static_cast<uint16_t>(second + first);
  }
  // Adds the type and payload of an item. Its sequence number follows from its place. Pause is that of Encoder.
  template <class Pause = NoPause>
  void add(const WireFrame& frame, uint8_t motors) {
    const uint8_t type = static_cast<uint8_t>(frame.type);
    const uint8_t* byte = frame.payload;
    const uint8_t size = payload_size(type, motors);
    uint8_t left = static_cast<uint8_t>(size - 1) / 2;  // words of payload alone
    ItemSums sums = *this;                              // a copy, kept in registers
    sums.add(static_cast<uint16_t>(type | *byte++ << 8));
    for (; left != 0; --left, byte += 2) {
      Pause{}();
      sums.add(static_cast<uint16_t>(byte[0] | byte[1] << 8));
    }
    if ((size & 1) == 0) sums.add(*byte);
    *this = sums;
  }
  // Adds what a replace announces: its own number, the item it replaces after, and the number of items.
  void add_announcement(uint16_t number, uint16_t after, uint8_t count) {
    add(number);
    add(after);
    add(count);
  }
  bool is_nothing() const { return (first | second) == 0; }

  // The sums to start with, so that both are 0 after `words` more words. These words must be the ones that made the
  // present sums, from 0.
  ItemSums to_leave_nothing(unsigned words) const {
    return {.first = static_cast<uint16_t>(0U - first), .second = static_cast<uint16_t>(words * first - second)};
  }
  // The number of words of an item.
  static constexpr unsigned describe(uint8_t type, uint8_t motors) { return (payload_size(type, motors) + 2U) / 2; }
  static constexpr unsigned words_of_announcement = 3;
};

}  // namespace passo
