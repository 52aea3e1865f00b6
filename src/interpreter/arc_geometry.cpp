#include "arc_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

double distance(PlanePoint a, PlanePoint b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

}  // namespace

CenterCheck check_center(PlanePoint start, PlanePoint end, PlanePoint center, const ArcTolerance& tolerance) {
  CenterCheck check{.start_radius = distance(start, center), .end_radius = distance(end, center)};
  const double error = std::fabs(check.start_radius - check.end_radius);
  const double relative = error / std::max(check.start_radius, check.end_radius);
  check.good = std::min(check.start_radius, check.end_radius) >= tolerance.least_radius &&
               error <= 100 * tolerance.radius_error &&
               (error <= tolerance.radius_error || relative <= tolerance.relative_error);
  return check;
}

bool center_from_radius(PlanePoint start, PlanePoint end, double radius, bool clockwise, const ArcTolerance& tolerance,
                        PlanePoint& center) {
  const PlanePoint middle{(start.first + end.first) / 2, (start.second + end.second) / 2};
  const double half_chord = distance(start, end) / 2;
  if (half_chord > std::fabs(radius) + tolerance.least_radius) return false;
  // A chord that is a diameter but for rounding makes a half circle.
  const double square = radius * radius - half_chord * half_chord;
  const double offset = half_chord / std::fabs(radius) > 1 - 1e-8 ? 0 : std::sqrt(std::max(0.0, square));
  // The centre lies beside the chord: to the right of it for a short clockwise arc.
  const double side = clockwise == (radius > 0) ? -1 : 1;
  const double along_first = (end.first - start.first) / (2 * half_chord);
  const double along_second = (end.second - start.second) / (2 * half_chord);
  center = {middle.first - side * offset * along_second, middle.second + side * offset * along_first};
  return true;
}

double swept_angle(PlanePoint start, PlanePoint end, PlanePoint center, bool clockwise, std::int32_t turns) {
  constexpr double turn = 2 * std::numbers::pi;
  const double from = std::atan2(start.second - center.second, start.first - center.first);
  const double to = std::atan2(end.second - center.second, end.first - center.first);
  double angle = clockwise ? from - to : to - from;
  // Start and end in one place, within LinuxCNC's millionth of a radian, are a full turn.
  if (angle < 1e-6) angle += turn;
  return angle + turn * (turns - 1);
}

}  // namespace passo
