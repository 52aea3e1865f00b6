// Where an arc's centre is, and whether there is such an arc. Pure geometry in the plane's own two axes.
//
// The limits are LinuxCNC's (interp_arc.cc): program coordinates are rounded, so start and end may lie on slightly
// different radii, and a radius may be slightly too small. grbl allows less.
#pragma once

#include <cstdint>

#include "passo/interpreter/plane_axes.hpp"

namespace passo {

struct PlanePoint {
  double first = 0;
  double second = 0;
  friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};
constexpr PlanePoint in_plane(const Point& point, const PlaneAxes& axes) {
  return {point[axes.first], point[axes.second]};
}

struct ArcTolerance {
  double radius;           // a smaller radius counts as none; R may be this much less than half the chord
  double absolute_spiral;  // start and end radius may differ by this much…
  static constexpr double relative_spiral = 0.001;  // …or by this part, up to a hundred times as much
};
inline constexpr double square_root_of_two = 1.41421356237309504880;
inline constexpr ArcTolerance arc_tolerance_mm{0.00127, 0.02 * square_root_of_two};
inline constexpr ArcTolerance arc_tolerance_inch{0.00127, 25.4 * 0.002 * square_root_of_two};  // in millimetres
inline constexpr ArcTolerance arc_tolerance_grbl{5e-7, 0.005};  // R as grbl's single precision tells it

enum class ArcFault : std::uint8_t { none, zero_radius, radii_differ, radius_too_small, ends_at_start };

struct ArcCenter {
  ArcFault fault = ArcFault::none;
  PlanePoint center;
  double start_radius = 0;
  double end_radius = 0;
};

// I J K format: the block gives the centre.
ArcCenter check_center(PlanePoint start, PlanePoint end, PlanePoint center, const ArcTolerance& tolerance);
// R format: two circles go through both points. The arc is the shorter one, or with a negative R the longer one.
ArcCenter center_from_radius(PlanePoint start, PlanePoint end, double radius, bool clockwise,
                             const ArcTolerance& tolerance);
// The angle from start to end about the centre, counterclockwise positive, in radians; `turns` as in
// operation::ArcFeed.
double arc_sweep(PlanePoint start, PlanePoint end, PlanePoint center, std::int32_t turns);

}  // namespace passo
