// StepMove: one move in whole steps, as a person states it: start, end, and for an arc its centre.
//
// A move that passes check() suits every interpolator of passo/interpolate.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/interpolate/arc_travel.hpp"

namespace passo {

using Place = std::vector<std::int64_t>;  // absolute steps, one for each axis

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

// Fails with the reason: axes that do not match, too long, no circle. The words fit after "the move ".
Status<std::string> check(const StepMove& move);

// Both are only for checked moves. Axes that the move lacks rest.
struct LineDistances {
  std::int32_t all[most_axes] = {};
};
LineDistances distances(const StepMove& move);
ArcPoints arc_points(const StepMove& move);

// "x", "y", "z", "a", "b", "c", "u", "v".
std::string axis_name(std::size_t axis);

}  // namespace passo
