// Runs an interpolator to its end and reports the position after each pulse.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "passo/interpolate/pulse.hpp"

namespace passo::test {

template <std::size_t axes>
using Place = std::array<std::int64_t, axes>;

template <std::size_t axes>
void apply(Pulse pulse, Place<axes>& place) {
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if ((pulse.steps >> axis & 1) != 0) place[axis] += (pulse.directions >> axis & 1) != 0 ? -1 : 1;
  }
}

// Calls visit(pulse, place, interpolator) after each pulse. Returns the end position.
template <std::size_t axes, class Interpolator, class Visit>
Place<axes> walk(Interpolator interpolator, Place<axes> place, Visit visit) {
  while (!interpolator.done()) {
    const Pulse pulse = interpolator.next();
    apply(pulse, place);
    visit(pulse, place, interpolator);
  }
  return place;
}

template <std::size_t axes, class Interpolator>
std::vector<Place<axes>> places(Interpolator interpolator, Place<axes> start = {}) {
  std::vector<Place<axes>> found;
  walk<axes>(interpolator, start,
             [&](Pulse, const Place<axes>& place, const Interpolator&) { found.push_back(place); });
  return found;
}

// Returns the number of random cases: PASSO_RUNS, or a number that is fast enough for development.
inline int runs(int otherwise) {
  const char* const given = std::getenv("PASSO_RUNS");
  return given != nullptr ? std::atoi(given) : otherwise;
}

}  // namespace passo::test
