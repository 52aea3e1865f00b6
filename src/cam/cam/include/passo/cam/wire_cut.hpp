// plan_wire_cut: plans cutting foam with a hot wire, along one profile or along two different ones at the left and
// right face of the block.
//
// The wire begins outside both profiles, moves to the point of maximum X, goes around the profile once, and leaves
// along its entry path. The wire is straight, so both ends move in synchronism: profiles with equal numbers of corners
// are matched corner by corner, others at the points of maximum and minimum X; in between, points are matched at equal
// fractions of the length.
//
// The slower end moves at the feed; the other end is faster, at most `most_feed`. A slower wire melts more foam, so
// each side is offset from its profile by half of its own kerf. From one measured kerf k at the speed v, the kerf at
// other speeds follows from a constant product k v, since the heat per length of wire is constant; with several
// measured kerfs it is interpolated and extrapolated linearly in 1 / v.
//
// The wire cannot follow an inward curve tighter than its kerf: a warning "wire.narrow". `lost_mm2` is computed by
// sweeping the wire along the plan.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

enum class WireKeeps : std::uint8_t { inside, outside, line };  // line: the wire follows the drawn line

struct WireKerf {
  double speed = 0;  // mm/min, above 0
  double width = 0;  // mm, 0 or more
};

// A line of a drawing. If it is closed, the last point leads back to the first.
struct WireProfile {
  std::vector<PathPoint> points = {};
  bool is_closed = true;
};

struct WireOptions {
  WireKeeps keeps = WireKeeps::inside;
  double feed = 200;  // mm/min
  double most_feed = 600;
  std::vector<WireKerf> kerf = {};  // at least one, by increasing speed
  Nanometres lead{10'000'000};      // distance of the start and end of the cut beyond both profiles and the block
  Nanometres block_end{};           // maximum X of the block, if it exceeds that of the profiles
  Nanometres tolerance{5'000};      // chord tolerance
  // Position along the wire, from the left tower; used if the two sides differ.
  Nanometres left_face{};
  Nanometres right_face{};
  Nanometres span{};
};

struct WirePlace {
  DrawnPoint left = {};
  DrawnPoint right = {};
};

struct WireSide {
  Region face = {};  // the area inside the profile
  double least_kerf = 0;
  double most_kerf = 0;   // maximum kerf, mm
  double way = 0;         // path length, mm
  double most_speed = 0;  // maximum speed, mm/min
  double lost_mm2 = 0;
};

struct WirePlan {
  std::vector<WirePlace> faces = {};    // positions of the wire at both faces of the block
  std::vector<WirePlace> towers = {};   // the same positions at the ends of the wire
  std::vector<double> minutes = {};     // duration of the move from the previous point, min; the first is 0
  std::vector<double> kerfs_left = {};  // kerf of the move to each point, mm
  std::vector<double> kerfs_right = {};
  WireSide left = {};
  WireSide right = {};
  std::size_t sections = 0;  // number of sections between matched points
};

// Reports errors and warnings "wire.…" in `diagnostics`.
WirePlan plan_wire_cut(const WireProfile& left, const WireProfile& right, const WireOptions& options,
                       Diagnostics& diagnostics);

// Returns the kerf in mm at a speed in mm/min.
double kerf_at(const std::vector<WireKerf>& measured, double speed);

}  // namespace passo
