// The layout of a segment in a frame. message.hpp has all other messages. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

constexpr uint16_t load16(const uint8_t* bytes) {
  return static_cast<uint16_t>(bytes[0] | bytes[1] << 8);
}
constexpr uint32_t load32(const uint8_t* bytes) {
  return load16(bytes) | static_cast<uint32_t>(load16(bytes + 2)) << 16;
}

template <class Pause = NoPause>
uint8_t encode(const BoardSegment& segment, uint8_t motors, uint8_t sequence, uint8_t* frame) {
  Encoder<Pause> encoder(frame, MessageType::segment, sequence);
  const bool fine = is_fine(segment.change);
  const uint16_t events = static_cast<uint16_t>(segment.events | segment.form << form_place);
  encoder.put16(fine ? events : static_cast<uint16_t>(events | coarse_bit));
  encoder.put8(segment.directions);
  const Bend bend = bend_of(segment);
  if (motors > most_motors_beside_bend) {
    encoder.put8(segment.flips);
    encoder.put8(segment.bend);
  } else {
    encoder.put8(static_cast<uint8_t>(segment.flips | bend.bent << 4 | bend.lender << 6));
  }
  encoder.put32(segment.interval);
  encoder.put24(static_cast<uint32_t>(fine ? segment.change : segment.change / coarse_change));
  for (uint8_t motor = 0; motor < motors; ++motor) encoder.put16(segment.increments[motor]);
  return encoder.finish();
}

// A separate function, because of the registers that it needs on a chip.
template <uint8_t room>
[[gnu::noinline]] void load_increments(const uint8_t* bytes, uint8_t motors, SegmentFor<room>& segment) {
  for (uint8_t motor = 0; motor < room; ++motor, bytes += 2) {
    segment.increments[motor] = motor < motors ? load16(bytes) : uint16_t{0};
  }
}

template <uint8_t room>
[[gnu::noinline]] void load_times(const uint8_t* bytes, bool coarse, SegmentFor<room>& segment) {
  segment.interval = load32(bytes);
  // 24 bits with a sign, stored in the upper bits. A large change is used as stored; a small one is shifted down, sign
  // included.
  segment.change =
      static_cast<int32_t>(static_cast<uint32_t>(load16(bytes + 4)) << 8 | static_cast<uint32_t>(bytes[6]) << 24);
  if (!coarse) segment.change >>= 8;
}

template <uint8_t room>
[[gnu::noinline]] void load_bend(uint8_t bent, uint8_t lender, uint8_t motors, SegmentFor<room>& segment) {
  constexpr uint8_t known = static_cast<uint8_t>((1U << SegmentFor<room>::half) - 1);
  segment.bend = static_cast<uint8_t>(bent | lender << bend_shift<room>) & known;
  if (lender < motors && bends_two(segment, lender)) {
    if (motors >= least_motors_to_bend_two && bent <= largest_scale) return;
  } else if (lender < motors && bent < motors) {
    return;
  }
  segment.events = 0;  // so that it is rejected
}

// `motors` is at most `room`.
template <uint8_t room>
void decode(const WireFrame& frame, uint8_t motors, SegmentFor<room>& segment) {
  constexpr uint8_t known = static_cast<uint8_t>((1U << SegmentFor<room>::half) - 1);
  const uint8_t* bytes = frame.payload;
  const uint16_t events = load16(bytes);
  segment.events = events & most_events;
  segment.form = static_cast<uint8_t>(events >> 8) >> (form_place - 8) & 0x0F;
  segment.directions = bytes[2] & known;
  // Further direction bits belong to motors that do not exist.
  if ((bytes[2] & static_cast<uint8_t>(~known)) != 0) segment.events = 0;
  segment.bend = 0;
  const uint8_t flips = bytes[3];
  if (motors > most_motors_beside_bend) {
    segment.flips = flips & known;
    ++bytes;
    if (bytes[3] != 0) load_bend(bytes[3] & 0x0F, bytes[3] >> 4, motors, segment);
  } else {
    segment.flips = flips & 0x0F;
    if (flips > 0x0F) load_bend(flips >> 4 & 3, flips >> 6, motors, segment);
  }
  load_times(bytes + 4, (events & coarse_bit) != 0, segment);
  load_increments(bytes + segment_size, motors, segment);
}

}  // namespace passo
