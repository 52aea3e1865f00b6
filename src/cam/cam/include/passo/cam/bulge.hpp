// Bulge: describes the arc between two points of a path; see PathPoint.
#pragma once

#include <algorithm>
#include <cmath>

#include "passo/cam/drawing.hpp"

namespace passo {

// Returns the sweep angle of an arc with this bulge, in radians; positive is counterclockwise.
inline double sweep_of(double bulge) {
  return 4 * std::atan(bulge);
}

// Returns the vector from the start of the arc to its centre. The centre lies on the perpendicular bisector of the
// chord: to the left of the chord for a counterclockwise arc of less than a half circle. The bulge must not be 0.
inline DrawnPoint to_centre(DrawnPoint from, DrawnPoint to, double bulge) {
  const double off = (1 - bulge * bulge) / (4 * bulge);
  const auto dx = static_cast<double>(to.x.count - from.x.count);
  const auto dy = static_cast<double>(to.y.count - from.y.count);
  return {{std::llround(dx / 2 - dy * off)}, {std::llround(dy / 2 + dx * off)}};
}

// Returns the length of the line or arc from one point to the other, in nanometres.
inline double way_nm(DrawnPoint from, DrawnPoint to, double bulge) {
  const double chord = distance_nm(from, to);
  if (bulge == 0) return chord;
  const double sweep = std::abs(sweep_of(bulge));
  return sweep * chord / 2 / std::sin(sweep / 2);
}

// Returns the point at this fraction of the length, from 0 to 1.
inline DrawnPoint point_along(DrawnPoint from, DrawnPoint to, double bulge, double share) {
  const auto dx = static_cast<double>(to.x.count - from.x.count);
  const auto dy = static_cast<double>(to.y.count - from.y.count);
  double lean = 0;
  double factor = share;
  if (bulge != 0) {
    // The chord from the start to a point at this fraction of the arc is rotated by half of the remaining sweep.
    const double sweep = sweep_of(bulge);
    lean = -sweep * (1 - share) / 2;
    factor = std::sin(sweep * share / 2) / std::sin(sweep / 2);
  }
  return {{from.x.count + std::llround(factor * (dx * std::cos(lean) - dy * std::sin(lean)))},
          {from.y.count + std::llround(factor * (dx * std::sin(lean) + dy * std::cos(lean)))}};
}

// Returns the number of equal chords that stay within the tolerance of the line or arc.
inline std::size_t chords_on(DrawnPoint from, DrawnPoint to, double bulge, Nanometres tolerance) {
  if (bulge == 0 || from == to) return 1;
  const double sweep = std::abs(sweep_of(bulge));
  const double radius = way_nm(from, to, bulge) / sweep;
  const double share = std::clamp(static_cast<double>(tolerance.count) / radius, 1e-9, 0.5);
  return static_cast<std::size_t>(std::max(1.0, std::ceil(sweep / (2 * std::acos(1 - share)))));
}

}  // namespace passo
