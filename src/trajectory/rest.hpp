// Where a path must rest between two of its segments. Private to trajectory/.
#pragma once

#include <algorithm>
#include <cmath>

#include "passo/path/segment.hpp"

namespace passo {

// If the directions of two segments differ by more, the path has a corner, and the motion must rest there. At 100 mm/s
// the speed of an axis jumps by 1e-4 mm/s where they differ by just that.
inline constexpr double tangent_tolerance = 1e-6;

inline bool rests_between(const Segment& before, const Segment& after) {
  if (before.mode == PathMode::exact_stop) return true;
  const Point change = after.curve.tangent(Mm(0)) - before.curve.tangent(before.curve.length());
  return std::any_of(change.values.begin(), change.values.end(),
                     [](double part) { return std::abs(part) > tangent_tolerance; });
}

}  // namespace passo
