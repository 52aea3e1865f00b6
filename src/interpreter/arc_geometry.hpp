// The centre of an arc from what a program says of it, in the two coordinates of its plane.
//
// Two formats (NIST RS274/NGC 3.5.3): the centre itself (I J K), or the radius R, where a negative one asks for the
// longer way round. The tolerances are LinuxCNC's.
#pragma once

#include <cstdint>
#include <numbers>

#include "passo/interpreter/operation.hpp"

namespace passo {

struct PlanePoint {
  double first = 0;
  double second = 0;
};

struct ArcTolerance {
  double least_radius;    // a smaller arc is none
  double radius_error;    // by which the radius at the end may differ from that at the start, if also …
  double relative_error;  // … within this part of the radius; a hundred times radius_error never
};
constexpr ArcTolerance arc_tolerance(LengthUnits units) {
  const double unit = units == LengthUnits::inch ? mm_per_inch : 1.0;
  const double rounding = units == LengthUnits::inch ? 0.001 : 0.01;
  return {.least_radius = 0.00005 * mm_per_inch,
          .radius_error = 2 * rounding * std::numbers::sqrt2 * unit,
          .relative_error = 0.001};
}

struct CenterCheck {
  bool good = false;
  double start_radius = 0;
  double end_radius = 0;
};
CenterCheck check_center(PlanePoint start, PlanePoint end, PlanePoint center, const ArcTolerance& tolerance);

// The centre for radius `radius`; false when the end is further away than the diameter.
bool center_from_radius(PlanePoint start, PlanePoint end, double radius, bool clockwise, const ArcTolerance& tolerance,
                        PlanePoint& center);

// Radians from start to end in the sense of `clockwise`, more than 0 and at most a full turn, and `turns` − 1 turns
// more.
double swept_angle(PlanePoint start, PlanePoint end, PlanePoint center, bool clockwise, std::int32_t turns);

}  // namespace passo
