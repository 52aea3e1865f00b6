// TableRamp: constant acceleration from a table, with one 16 × 16 multiplication a step: c_n = (K_b · k_n) >> 16.
//
// A walk over the index n, one up or down at a time, so a motor brakes with the intervals that it started with. An
// error stays in its own interval. An interval is short by less than K_b/65536 + 1 ticks, so by less than two; where a
// real K_b was cut off to a whole number, by up to k_n ticks more. No interval is too long, so a run ends early by the
// sum of these errors.
//
// Ranges: 1 <= K_b < 65536 ticks. A longer first interval is refused, never wrapped; a slower timer clock or another
// method then helps. At the end of the table the motor goes on at the speed it has.
// Table is a type with `uint16_t size() const` and `uint16_t scaled(uint16_t first, uint16_t n) const`, the product
// (ramp_table.hpp). A chip's own table reads flash and multiplies in the chip's best way.
// Portable: no division.
#pragma once

#include <stdint.h>

namespace passo {

template <class Table>
class TableRamp {
 public:
  using Interval = uint16_t;
  static constexpr uint16_t longest_first_interval = 0xffff;

  explicit constexpr TableRamp(Table table = Table()) : table_(table) {}

  // Sets K_b = c_0, in ticks, and goes to index 0. Returns false and changes nothing if K_b does not fit.
  [[nodiscard]] constexpr bool set_first_interval(uint32_t ticks) {
    if (ticks == 0 || ticks > longest_first_interval) return false;
    first_ = static_cast<uint16_t>(ticks);
    index_ = 0;
    return true;
  }

  constexpr uint16_t index() const { return index_; }
  // c_n of the present index n, in ticks.
  constexpr uint16_t interval() const { return interval_of(index_); }
  // The shortest interval there is: the one at the table's end.
  constexpr uint16_t fastest() const { return interval_of(static_cast<uint16_t>(table_.size() - 1)); }

  // Goes to n + 1. At the table's end n stays.
  constexpr void rise() {
    const uint16_t next = static_cast<uint16_t>(index_ + 1);
    if (next < table_.size()) index_ = next;
  }
  // Goes to n − 1. Only where n > 0.
  constexpr void fall() { --index_; }

 private:
  constexpr uint16_t interval_of(uint16_t n) const {
    if (n == 0) return first_;
    return table_.scaled(first_, n);
  }

  [[no_unique_address]] Table table_;
  uint16_t first_ = longest_first_interval;
  uint16_t index_ = 0;
};

}  // namespace passo
