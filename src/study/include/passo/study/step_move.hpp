// StepMove: one move in whole steps, as a person states it: from, to, and for an arc its centre.
//
// What check() lets pass, every interpolator of passo/interpolate can take.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/interpolate/arc_travel.hpp"

namespace passo {

using Place = std::vector<std::int64_t>;  // absolute steps, an axis each

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

// Why it is no move: axes that do not match, too long, no circle. The words fit after "the move ".
Status<std::string> check(const StepMove& move);

// Both for checked moves only. Axes that the move lacks rest.
struct LineDistances {
  std::int32_t all[most_axes] = {};
};
LineDistances distances(const StepMove& move);
ArcPoints arc_points(const StepMove& move);

// "x", "y", "z", "a", "b", "c", "u", "v".
std::string axis_name(std::size_t axis);

}  // namespace passo
