// Region: an area of any shape, such as the copper of a layer or the area that a cutter has milled.
//
// Lengths are whole nanometres, X to the right, Y up. A region is a list of rings that neither cross nor overlap: outer
// rings counterclockwise, holes clockwise, so the region lies to the left of every ring. The last point of a ring leads
// back to the first. Coordinates are limited to 200 m (`farthest_of_region`); points beyond are moved to the limit, so
// no sum or product overflows. Every function returns such a region, and equal input gives equal output.
//
// Intersections of edges are rounded to whole nanometres. Curves become chords: rounded corners and offsets stay within
// `tolerance` of the true curve, on its inside.
//
// Source: B. R. Vatti, A generic solution to polygon clipping (1992); the library Clipper 6.4.2 of A. Johnson.
#pragma once

#include <cstdint>
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

// Fills each ring, whatever its direction, and unites all of them. A self-crossing ring is filled where its winding
// number is not zero. Rings of fewer than three points are ignored.
Region filled(std::vector<DrawnRing> rings);

// Fills the rings together, where their winding number is odd or where it is not zero.
enum class FillRule : std::uint8_t { even_odd, nonzero };
Region filled_together(std::vector<DrawnRing> rings, FillRule rule);

Region united(const Region& a, const Region& b);
Region united(const std::vector<Region>& regions);
Region subtracted(const Region& from, const Region& what);
Region common(const Region& a, const Region& b);

// Offsets the region: returns all points at most `distance` from the region; corners are rounded. A negative distance
// shrinks the region.
Region grown(const Region& region, Nanometres distance, Nanometres tolerance = usual_chord_tolerance);

// Returns all points at most `radius` from the polylines: the area that a cutter mills along these toolpaths. A single
// point gives a disc.
Region swept(const std::vector<DrawnRing>& ways, Nanometres radius, Nanometres tolerance = usual_chord_tolerance);

// Returns the pieces of the open polylines that lie in the region, in any order and direction.
std::vector<DrawnRing> ways_within(const std::vector<DrawnRing>& ways, const Region& region);

// Splits the region into its parts: each is one outer ring, which comes first, and its holes.
std::vector<Region> parts_of(const Region& region);

// Returns for each island, which must be a single part, the index of the part that contains its first point;
// parts.size() if there is none.
std::vector<std::size_t> parts_with(const std::vector<Region>& islands, const std::vector<Region>& parts);

// Returns the area in square millimetres. The sum is exact; only the result is rounded.
double area_mm2(const Region& region);
double area_mm2(const DrawnRing& ring);  // negative if the ring is clockwise

// Returns the bounding box. Empty for an empty region.
std::optional<DrawnBox> bounds(const Region& region);
DrawnBox box_of(const DrawnRing& ring);  // Requires a ring of at least one point.
DrawnRing rectangle(const DrawnBox& box);

// Returns whether the region contains the point. Points on the boundary are inside.
bool contains(const Region& region, DrawnPoint point);

}  // namespace passo
