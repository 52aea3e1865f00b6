// StepMove: one move in whole steps, as entered by the user: start, end, and for an arc its centre.
//
// A move that passes check() is valid for every interpolator of passo/interpolate.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/interpolate/arc_travel.hpp"

namespace passo {

using Place = std::vector<std::int64_t>;  // absolute steps, one entry per axis

struct StepMove {
  struct Arc {
    Place centre;
    bool clockwise = false;
  };
  Place from;
  Place to;
  std::optional<Arc> arc;

  std::size_t axes() const { return to.size(); }
};

// Fails with the reason: inconsistent axes, too long, no circle. The text can follow "the move ".
Status<std::string> check(const StepMove& move);

// Both require a checked move. Axes that the move lacks do not move.
struct LineDistances {
  std::int32_t all[most_axes] = {};
};
LineDistances distances(const StepMove& move);
ArcPoints arc_points(const StepMove& move);

// Returns "x", "y", "z", "a", "b", "c", "u" or "v".
std::string axis_name(std::size_t axis);

}  // namespace passo
