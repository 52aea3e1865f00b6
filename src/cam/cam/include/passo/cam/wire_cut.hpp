// plan_wire_cut: how a hot wire cuts a block of foam, with one profile or with two, at its left and its right face.
//
// The wire begins beside both profiles, comes to its place of greatest X, goes around it once, and leaves as it came.
// It is straight, so both ends arrive everywhere together: the profiles are matched corner by corner where they have
// equally many, else at the greatest and the least X; between these, place by place at equal shares of the way.
//
// The slower end moves at the feed, and the other end faster, at most at `most_feed`. A wire that moves more slowly
// melts more: each side keeps off its profile by half of its own kerf. Of one measured kerf k at the speed v the
// product k v is the same at all speeds, for the heat of a length of wire is; between several measured ones, and beyond
// them, the kerf is a line over 1 / v.
//
// Where the profile turns inwards more tightly than the wire melts, the wire cannot go: a warning "wire.narrow".
// `lost_mm2` is found by a sweep of the wire along what is planned.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

enum class WireKeeps : std::uint8_t { inside, outside, line };  // line: the wire goes on the drawn line

struct WireKerf {
  double speed = 0;  // mm a minute, above 0
  double width = 0;  // mm, 0 or more
};

// A line of a drawing. Of a closed one the last point leads back to the first.
struct WireProfile {
  std::vector<PathPoint> points = {};
  bool is_closed = true;
};

struct WireOptions {
  WireKeeps keeps = WireKeeps::inside;
  double feed = 200;  // mm a minute
  double most_feed = 600;
  std::vector<WireKerf> kerf = {};  // one or more, by rising speed
  Nanometres lead{10'000'000};      // how far beyond both profiles, and the block, the cut begins and ends
  Nanometres block_end{};           // the greatest X of the block, where that is more than the profiles'
  Nanometres tolerance{5'000};      // of chords
  // Along the wire, from the left tower: used where the two sides differ.
  Nanometres left_face{};
  Nanometres right_face{};
  Nanometres span{};
};

struct WirePlace {
  DrawnPoint left = {};
  DrawnPoint right = {};
};

struct WireSide {
  Region face = {};  // inside the profile
  double least_kerf = 0;
  double most_kerf = 0;   // mm
  double way = 0;         // mm
  double most_speed = 0;  // mm a minute
  double lost_mm2 = 0;
};

struct WirePlan {
  std::vector<WirePlace> faces = {};    // of the block: where the wire is at both
  std::vector<WirePlace> towers = {};   // the same places of the wire at its ends
  std::vector<double> minutes = {};     // from the place before; the first is 0
  std::vector<double> kerfs_left = {};  // mm, of the way to each place
  std::vector<double> kerfs_right = {};
  WireSide left = {};
  WireSide right = {};
  std::size_t sections = 0;  // between places that are matched
};

// Errors and warnings "wire.…" are in `diagnostics`.
WirePlan plan_wire_cut(const WireProfile& left, const WireProfile& right, const WireOptions& options,
                       Diagnostics& diagnostics);

// The kerf at a speed, mm and mm a minute.
double kerf_at(const std::vector<WireKerf>& measured, double speed);

}  // namespace passo
