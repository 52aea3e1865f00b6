// TravelSwitch: a limit switch in a plant, closed by an axis near an end of its travel.
#pragma once

#include <array>
#include <cstdint>

#include "passo/units/units.hpp"

namespace passo {

// Positions are in steps of the switch's motor. A switch has hysteresis: `opens_at` is further from the end of the
// travel than `closes_at`.
struct TravelSwitch {
  std::uint16_t input = 0;  // bit of BoardInput; several switches may share one
  std::uint8_t motor = 0;
  bool at_high_end = false;
  std::int64_t closes_at = 0;
  std::int64_t opens_at = 0;
  Seconds bounce{0};  // how long the contact opens and closes after each change

  // Whether the switch is closed with its motor at `position`. `before`: whether it was closed before.
  bool closed(double position, bool before) const {
    const auto at = static_cast<double>(before ? opens_at : closes_at);
    // At `opens_at` itself the switch is open.
    if (at_high_end) return before && opens_at != closes_at ? position > at : position >= at;
    return before && opens_at != closes_at ? position < at : position <= at;
  }

  // Returns whether the contact, which began to change `since` ago, shows its new state. Initially it does.
  bool shows_change(Seconds since) const {
    constexpr std::array<double, 6> turns{0.08, 0.21, 0.35, 0.42, 0.71, 0.83};  // as fractions of the bounce time
    bool shown = true;
    for (const double turn : turns) {
      if (since.value() >= turn * bounce.value()) shown = !shown;
    }
    return shown;
  }
};

}  // namespace passo
