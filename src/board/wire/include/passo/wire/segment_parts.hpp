// SegmentParts: divides a segment into the parts that the board executes. A part is quadratic: its interval changes by
// the same amount at each event.
//
// The form of a segment determines the length of its parts, and how the change of the interval develops from part to
// part.
//
//   even    (form 0)              The change is constant. Parts have 255 events, because a player counts in eight bits.
//   root    (root_form + k)       Parts have 2^k events. Motion with a constant acceleration: the time is a square root
//                                 of the distance. The segment's `change` is a growth v, in 1/2^31.
//
// Root. Where j parts are left until the motion would rest, v = 1/j, and the interval of the part after this one is
// longer by the factor sqrt(j / (j - 1)) = 1 / sqrt(1 - v). During acceleration, v = -1/j, where j parts have passed
// since standstill. One segment can thus decelerate from any speed; quadratic segments would need one for each halving
// of the distance. Root and quotient are computed by series: host and board compute the same bits, without a division.
//
//   factor - 1 = v/2 + 3/8 v²        next v = v / (1 - v) = v + v² + v³
//
// Portable: integers only, 32 bits.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"

namespace passo {

inline constexpr uint8_t longest_part = 0xFF;

constexpr bool is_root(uint8_t form) {
  return (form & root_form) != 0;
}
// The number of events in each part except the last.
constexpr uint8_t part_length(uint8_t form) {
  return form == 0 ? longest_part : static_cast<uint8_t>(1U << (form & ~root_form));
}

// Returns a b / 2^32, from 16-bit products, the only ones on a small chip. The functions here are small and separate,
// because of the registers that they need on a chip.
[[gnu::noinline]] constexpr int16_t upper_of(int16_t high, uint16_t low) {
  return static_cast<int16_t>((int32_t{high} * int32_t{low}) >> 16);
}
[[gnu::noinline]] constexpr int32_t sides_of(int32_t a, int32_t b) {
  const int16_t one_side = upper_of(static_cast<int16_t>(a >> 16), static_cast<uint16_t>(b));
  return int32_t{upper_of(static_cast<int16_t>(b >> 16), static_cast<uint16_t>(a))} + one_side;
}
[[gnu::noinline]] constexpr int32_t product_of(int16_t a, int16_t b) {
  return int32_t{a} * int32_t{b};
}
// Pause{}() is called between the products, here and below. A chip's Pause may have a faster product of its own.
template <class Pause = NoPause>
[[gnu::noinline]] constexpr int32_t high_product(int32_t a, int32_t b) {
  if constexpr (requires { Pause::high_product(a, b); }) return Pause::high_product(a, b);
  const int32_t sides = sides_of(a, b);
  Pause{}();
  return sides + product_of(static_cast<int16_t>(a >> 16), static_cast<int16_t>(b >> 16));
}
// Returns a b / 2^31: the product of fractions.
template <class Pause = NoPause>
[[gnu::noinline]] constexpr int32_t times_fraction(int32_t a, int32_t b) {
  return static_cast<int32_t>(static_cast<uint32_t>(high_product<Pause>(a, b)) << 1);
}

// Returns twice (factor - 1), in 1/2^31.
template <class Pause = NoPause>
[[gnu::noinline]] constexpr int32_t twice_factor(int32_t growth) {
  const int32_t squared = times_fraction<Pause>(growth, growth);
  // Behind the last part it may leave the range; nobody uses it then.
  return static_cast<int32_t>(static_cast<uint32_t>(growth) + static_cast<uint32_t>(squared >> 1) +
                              static_cast<uint32_t>(squared >> 2));
}
// Returns the change at each event of a part of 2^k events that begins with that interval.
template <class Pause = NoPause>
[[gnu::noinline]] constexpr int32_t root_change(uint32_t interval, int32_t twice, uint8_t k) {
  const uint32_t longer = static_cast<uint32_t>(high_product<Pause>(static_cast<int32_t>(interval >> 1), twice)) << 1;
  return static_cast<int32_t>(longer) >> k;
}
template <class Pause = NoPause>
[[gnu::noinline]] constexpr int32_t next_growth(int32_t growth) {
  const uint32_t squared = static_cast<uint32_t>(times_fraction<Pause>(growth, growth));
  Pause{}();
  const uint32_t cubed = static_cast<uint32_t>(times_fraction<Pause>(static_cast<int32_t>(squared), growth));
  return static_cast<int32_t>(static_cast<uint32_t>(growth) + squared + cubed);
}

// The times of the current part.
struct PartTimes {
  uint32_t interval = 0;  // of its first event
  int32_t change = 0;
  int32_t growth = 0;

  template <uint8_t motors>
  constexpr void begin(const SegmentFor<motors>& segment) {
    interval = segment.interval;
    growth = segment.change;
    change =
        is_root(segment.form) ? root_change(interval, twice_factor(growth), segment.form & ~root_form) : segment.change;
  }
  // Advances to the next part.
  constexpr void go_on(uint8_t form) {
    interval += static_cast<uint32_t>(change) * part_length(form);
    if (!is_root(form)) return;
    growth = next_growth(growth);
    change = root_change(interval, twice_factor(growth), form & ~root_form);
  }
};

// Applies the bend to `increments`, from one part to the next. Call only for segments with a bend.
template <uint8_t motors>
[[gnu::noinline]] constexpr void bend_on(const SegmentFor<motors>& segment, uint16_t* increments) {
  const auto grow = [increments](uint8_t motor, uint16_t by) {
    increments[motor] = static_cast<uint16_t>(increments[motor] + by);
  };
  const Bend bend = bend_of(segment);
  const uint16_t lent = segment.increments[bend.lender];
  if (!bends_two(segment, bend.lender)) return grow(bend.bent, lent);
  const uint8_t unit = static_cast<uint8_t>(1U << 2 * bend.bent);
  grow(first_beside(bend.lender), static_cast<uint16_t>(static_cast<int8_t>(lent & 0xFF) * unit));
  grow(second_beside(bend.lender), static_cast<uint16_t>(static_cast<int8_t>(lent >> 8) * unit));
}

// Calls `each` with the times of each part, its number of events, and the number of events before it.
template <uint8_t motors, class Each>
constexpr void for_each_part(const SegmentFor<motors>& segment, const Each& each) {
  PartTimes times;
  times.begin(segment);
  const uint16_t length = part_length(segment.form);
  for (uint16_t done = 0; done < segment.events; times.go_on(segment.form)) {
    const uint16_t left = static_cast<uint16_t>(segment.events - done);
    const uint16_t events = left < length ? left : length;
    each(times, events, done);
    done = static_cast<uint16_t>(done + events);
  }
}

// Returns the time of the segment's first `most` events, in 1/65536 tick. For the host.
template <uint8_t motors>
constexpr int64_t duration(const SegmentFor<motors>& segment, int32_t most) {
  const auto quadratic = [](int64_t interval, int64_t change, int64_t events) {
    return events * interval + change * (events * (events - 1) / 2);
  };
  const int32_t all = segment.events;
  if (segment.form == 0) return quadratic(segment.interval, segment.change, most < all ? most : all);
  int64_t time = 0;
  for_each_part(segment, [&](const PartTimes& part, int32_t events, int32_t before) {
    if (most <= before) return;
    time += quadratic(part.interval, part.change, most - before < events ? most - before : events);
  });
  return time;
}

}  // namespace passo
