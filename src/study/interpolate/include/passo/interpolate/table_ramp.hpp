// TableRamp: constant acceleration from a table, with one 16 × 16 multiplication per step: c_n = (K_b · k_n) >> 16.
//
// The index n goes up or down by one at a time, so a motor brakes with the same intervals as in acceleration. An error
// affects only its own interval. An interval is short by less than K_b/65536 + 1 ticks, i.e. by less than two; if a
// real K_b was truncated to a whole number, by up to k_n ticks more. No interval is too long, so a run ends early by
// the sum of these errors.
//
// Ranges: 1 <= K_b < 65536 ticks. A longer first interval is refused and never wraps around; use a slower timer clock
// or another method. At the end of the table the motor keeps its speed. Table is a type with `uint16_t size() const`
// and `uint16_t scaled(uint16_t first, uint16_t n) const`, the product (ramp_table.hpp). A chip's own table reads flash
// memory and multiplies in the chip's most efficient way. Portable: no division.
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
  // Returns c_n of the current index n, in ticks.
  constexpr uint16_t interval() const { return interval_of(index_); }
  // Returns the shortest interval: the one at the end of the table.
  constexpr uint16_t fastest() const { return interval_of(static_cast<uint16_t>(table_.size() - 1)); }

  // Goes to n + 1. At the end of the table n stays.
  constexpr void rise() {
    const uint16_t next = static_cast<uint16_t>(index_ + 1);
    if (next < table_.size()) index_ = next;
  }
  // Goes to n − 1. Requires n > 0.
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
