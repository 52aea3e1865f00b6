// OutsideTravel: the axes on which a path is outside the travel, at each end of it. An excursion begins with the first
// move that leaves the travel, and lasts until a move ends within it. It is thus reported once and not at each move.
#pragma once

#include <cstdint>

#include "passo/geometry/axes.hpp"

namespace passo {

enum class TravelEnd : std::uint8_t { low, high };

class OutsideTravel {
 public:
  // Call when a move leaves the travel at this end. `ends_outside`: the move also ends outside. Returns true if a new
  // excursion has begun.
  bool leaves(Axis axis, TravelEnd end, bool ends_outside) {
    AxisSet& axes = at(end);
    const bool is_new = !axes.has(axis);
    if (ends_outside) {
      axes.add(axis);
    } else {
      axes.remove(axis);
    }
    return is_new;
  }
  void stays_within(Axis axis, TravelEnd end) { at(end).remove(axis); }

 private:
  AxisSet& at(TravelEnd end) { return end == TravelEnd::low ? below_ : above_; }

  AxisSet below_;
  AxisSet above_;
};

}  // namespace passo
