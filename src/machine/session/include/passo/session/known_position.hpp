// KnownPosition: where a machine stands, and how far that position can be trusted.
#pragma once

#include <cstdint>
#include <string_view>

#include "passo/geometry/axes.hpp"

namespace passo {

enum class Trust : std::uint8_t {
  unknown,    // nobody knows: the machine was never homed, or the motors were stopped at once
  commanded,  // the board has played what was sent, as far as the host knows
  counted,    // the board's counts agree with what was commanded
  homed,      // counted, from a place that the switches have shown; axes without a switch: from a known place
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
  AxisSet downs = {};  // the axes whose backlash is taken up for motion down; none, unless a motion was stopped
  // With Trust::unknown: counting has been broken off, so work offsets of before are wrong. False: nobody has ever
  // known where machine zero is, and the counts have gone on.
  bool is_lost = false;
  friend bool operator==(const KnownPosition&, const KnownPosition&) = default;
};

}  // namespace passo
