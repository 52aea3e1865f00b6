// Region: a face of any shape, as the copper of a layer or the ground that a cutter has milled.
//
// Lengths are whole nanometres, X to the right, Y up. A region is a row of rings that neither cross nor overlap: outer
// rings counterclockwise, holes clockwise, so the region lies to the left of every ring. The last point of a ring leads
// back to the first. Coordinates are at most 200 m from zero (`farthest_of_region`); what lies beyond is moved there,
// so no sum and no product overflows. Every function gives such a region, and equal input gives equal output.
//
// Crossings of edges are rounded to whole nanometres. Curves are chords: what a function rounds off or grows keeps
// within `tolerance` of the true curve, and inside it.
//
// Source: B. R. Vatti, A generic solution to polygon clipping (1992); the library Clipper 6.4.2 of A. Johnson.
#pragma once

#include <optional>
#include <vector>

#include "passo/cam/drawing.hpp"

namespace passo {

using DrawnRing = std::vector<DrawnPoint>;

struct Region {
  std::vector<DrawnRing> rings = {};

  bool empty() const { return rings.empty(); }
};

struct DrawnBox {
  DrawnPoint least = {};
  DrawnPoint most = {};
};

inline constexpr Nanometres farthest_of_region{2 * farthest_drawn.count};
inline constexpr Nanometres usual_chord_tolerance{1000};

// Each ring is filled, whichever way it turns, and all are united. A ring that crosses itself is filled where it winds
// around a point at least once. Rings of fewer than three points are nothing.
Region filled(std::vector<DrawnRing> rings);

Region united(const Region& a, const Region& b);
Region united(const std::vector<Region>& regions);
Region subtracted(const Region& from, const Region& what);
Region common(const Region& a, const Region& b);

// All that is at most `distance` from the region; corners become round. A distance below 0 leaves what is at least that
// far inside the region.
Region grown(const Region& region, Nanometres distance, Nanometres tolerance = usual_chord_tolerance);

// All that is at most `radius` from the lines along the points: what a cutter mills on its way. A way of one point is a
// disc.
Region swept(const std::vector<DrawnRing>& ways, Nanometres radius, Nanometres tolerance = usual_chord_tolerance);

// The pieces of the open ways that lie in the region, in any order and direction.
std::vector<DrawnRing> ways_within(const std::vector<DrawnRing>& ways, const Region& region);

// Each part is one outer ring, which comes first, and the holes in it.
std::vector<Region> parts_of(const Region& region);

// For each of the islands, each one part, the index of the part that its first point lies in; beyond the last: none.
std::vector<std::size_t> parts_with(const std::vector<Region>& islands, const std::vector<Region>& parts);

// In square millimetres. The sum is exact; only the answer is rounded.
double area_mm2(const Region& region);
double area_mm2(const DrawnRing& ring);  // below 0 if the ring is clockwise

// Empty for an empty region.
std::optional<DrawnBox> bounds(const Region& region);
DrawnBox box_of(const DrawnRing& ring);  // of one point or more
DrawnRing rectangle(const DrawnBox& box);

// A point on the rim is inside.
bool contains(const Region& region, DrawnPoint point);

}  // namespace passo
