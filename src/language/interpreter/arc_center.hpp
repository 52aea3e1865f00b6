// Computes the centre of an arc, and checks that the arc exists. Pure geometry in the two axes of the plane.
//
// The limits are LinuxCNC's (interp_arc.cc): program coordinates are rounded, so the radii at start and end may differ
// slightly, and R may be slightly too small. grbl is stricter.
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
  double radius;           // a smaller radius counts as zero; R may be less than half the chord by this much
  double absolute_spiral;  // maximum difference of the start and end radius…
  static constexpr double relative_spiral = 0.001;  // …or this fraction of the radius, up to a hundred times the
                                                    // absolute limit
};
inline constexpr double square_root_of_two = 1.41421356237309504880;
inline constexpr ArcTolerance arc_tolerance_mm{0.00127, 0.02 * square_root_of_two};
inline constexpr ArcTolerance arc_tolerance_inch{0.00127, 25.4 * 0.002 * square_root_of_two};  // in millimetres
inline constexpr ArcTolerance arc_tolerance_grbl{5e-7, 0.005};  // R has grbl's single precision

enum class ArcFault : std::uint8_t { none, zero_radius, radii_differ, radius_too_small, ends_at_start };

struct ArcCenter {
  ArcFault fault = ArcFault::none;
  PlanePoint center;
  double start_radius = 0;
  double end_radius = 0;
};

// I J K format: checks the centre given by the block.
ArcCenter check_center(PlanePoint start, PlanePoint end, PlanePoint center, const ArcTolerance& tolerance);
// R format: two circles pass through both points. The arc is the shorter one, or the longer one if R is negative.
ArcCenter center_from_radius(PlanePoint start, PlanePoint end, double radius, bool clockwise,
                             const ArcTolerance& tolerance);
// Returns the angle from start to end about the centre, counterclockwise positive, in radians; `turns` as in
// operation::ArcFeed.
double arc_sweep(PlanePoint start, PlanePoint end, PlanePoint center, std::int32_t turns);

}  // namespace passo
