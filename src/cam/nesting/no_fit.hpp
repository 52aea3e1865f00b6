// The polygons of the nest, in whole steps of 0.1 micrometres. Private to nesting/.
//
// Clipper calculates with them: all coordinates stay below 2^30, where it needs no 128-bit products.
#pragma once

#include <polyclipping/clipper.hpp>

#include "passo/cam/region.hpp"

namespace passo::nesting {

using Polygons = ClipperLib::Paths;
using Spot = ClipperLib::IntPoint;

struct Extent {
  Spot least{};
  Spot most{};
};

inline constexpr std::int64_t nanometres_per_step = 100;

ClipperLib::cInt steps_of(Nanometres length);
std::size_t corner_count(const Polygons& polygons);
Polygons moved(Polygons polygons, const Spot& by);
Polygons turned(const Polygons& polygons, double degrees);

// The outside of the outlines, with few corners, grown by `by`, and by as much as the omitted corners need.
// Counterclockwise. `most_corners`: the more corners are omitted, the more it is grown.
Polygons grown_outside(const std::vector<DrawnRing>& outlines, double by, std::size_t most_corners);

// The positions of a moving shape at which it overlaps the resting one. Both are outsides.
Polygons no_fit_polygon(const Polygons& resting, const Polygons& moving);

// Removes polygons, each moved by its spot, from the free positions.
struct Blocked {
  const Polygons* polygons = nullptr;
  Spot at{};
};
Polygons without(const Polygons& free, const std::vector<Blocked>& blocked);

}  // namespace passo::nesting
