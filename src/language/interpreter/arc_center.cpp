#include "arc_center.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

double distance_between(PlanePoint a, PlanePoint b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

// The same but for the last bit, and faster: every arc with a centre needs two of them.
double quick_distance(PlanePoint a, PlanePoint b) {
  const double first = a.first - b.first;
  const double second = a.second - b.second;
  const double square = first * first + second * second;
  return square > 1e-200 && square < 1e200 ? std::sqrt(square) : std::hypot(first, second);
}

}  // namespace

ArcCenter check_center(PlanePoint start, PlanePoint end, PlanePoint center, const ArcTolerance& tolerance) {
  ArcCenter arc{ArcFault::none, center, quick_distance(center, start), quick_distance(center, end)};
  const double difference = std::abs(arc.start_radius - arc.end_radius);
  const double largest = std::max(arc.start_radius, arc.end_radius);
  if (std::min(arc.start_radius, arc.end_radius) < tolerance.radius) {
    arc.fault = ArcFault::zero_radius;
  } else if (difference > 100 * tolerance.absolute_spiral ||
             (difference > tolerance.absolute_spiral && difference > ArcTolerance::relative_spiral * largest)) {
    arc.fault = ArcFault::radii_differ;
  }
  return arc;
}

//          center
//            +            The centre is `height` away from the middle of the chord. For a short counterclockwise arc
//           /|            it is to the left of start -> end.
//    radius/ |height
//         /  |
//   start+---+---+end
//         half
ArcCenter center_from_radius(PlanePoint start, PlanePoint end, double radius, bool clockwise,
                             const ArcTolerance& tolerance) {
  constexpr double semicircle = 1e-12;  // if half / size is this near to 1, the height is noise: a semicircle
  ArcCenter arc;
  if (start == end) {
    arc.fault = ArcFault::ends_at_start;
    return arc;
  }
  const double half = distance_between(start, end) / 2;
  const double size = std::abs(radius);
  if (half - size > tolerance.radius) {
    arc.fault = ArcFault::radius_too_small;
    return arc;
  }
  const double ratio = half / size;
  const double height = ratio > 1 - semicircle ? 0 : size * std::sqrt((1 - ratio) * (1 + ratio));
  const double side = clockwise == (radius > 0) ? -height : height;
  const double along_first = (end.first - start.first) / (2 * half);
  const double along_second = (end.second - start.second) / (2 * half);
  arc.center = {(start.first + end.first) / 2 - side * along_second,
                (start.second + end.second) / 2 + side * along_first};
  arc.start_radius = arc.end_radius = std::max(size, half);
  return arc;
}

double arc_sweep(PlanePoint start, PlanePoint end, PlanePoint center, std::int32_t turns) {
  constexpr double full = 2 * std::numbers::pi;
  const double from = std::atan2(start.second - center.second, start.first - center.first);
  const double to = std::atan2(end.second - center.second, end.first - center.first);
  double sweep = to - from;
  if (turns > 0) {
    if (sweep <= 0) sweep += full;
    return sweep + (turns - 1) * full;
  }
  if (sweep >= 0) sweep -= full;
  return sweep + (turns + 1) * full;
}

}  // namespace passo
