// KnownPosition: the position of a stopped machine, and how certain it is.
#pragma once

#include <cstdint>
#include <string_view>

#include "passo/geometry/axes.hpp"

namespace passo {

enum class Trust : std::uint8_t {
  unknown,    // the machine was never homed, or the motors were stopped instantly
  commanded,  // all sent items are reported as executed
  counted,    // the board's step counts agree with the commanded position
  homed,      // counted from a homed position; axes without a switch: from a known position
};
constexpr std::string_view name_of(Trust trust) {
  switch (trust) {
    case Trust::unknown: return "unknown";
    case Trust::commanded: return "commanded";
    case Trust::counted: return "counted";
    case Trust::homed: return "homed";
  }
  return "";
}

struct KnownPosition {
  Point place;  // machine coordinates
  Trust trust = Trust::unknown;
  AxisSet downs = {};  // the axes whose backlash is taken up for motion in the negative direction; none, unless a
                       // motion was stopped
  // With Trust::unknown: step counting was interrupted, so earlier work offsets are wrong. False: machine zero was
  // never known, and counting has continued.
  bool is_lost = false;
  friend bool operator==(const KnownPosition&, const KnownPosition&) = default;
};

}  // namespace passo
