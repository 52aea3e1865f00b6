// for_chords: divides a Bézier curve into chords. Private to cam/.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace passo {

// Calls emit(x, y) for the end point of each chord, the last of which is the end of the curve, until emit returns
// false. `p`: the three or four control points of the curve. `scale`: millimetres per curve unit. The chords have equal
// parameter steps, chosen from the curve's second differences so that the tolerance holds. Returns false if more than a
// million chords would be needed.
template <class Point, class Emit>
bool for_chords(std::span<const Point> p, double scale, double tolerance_mm, const Emit& emit) {
  const std::size_t degree = p.size() - 1;
  double bend = 0;
  for (std::size_t i = 0; i + 2 < p.size(); ++i) {
    bend = std::max(bend, std::hypot(p[i].x - 2 * p[i + 1].x + p[i + 2].x, p[i].y - 2 * p[i + 1].y + p[i + 2].y));
  }
  const auto d = static_cast<double>(degree);
  const double wanted = std::ceil(std::sqrt(d * (d - 1) / 8 * bend * scale / tolerance_mm));
  if (!(wanted < 1e6)) return false;
  for (double i = 1; i < wanted; ++i) {
    const double u = i / wanted;
    const double v = 1 - u;
    const auto mix = [&](auto along) {
      return degree == 2 ? v * v * along(p[0]) + 2 * v * u * along(p[1]) + u * u * along(p[2])
                         : v * v * v * along(p[0]) + 3 * v * v * u * along(p[1]) + 3 * v * u * u * along(p[2]) +
                               u * u * u * along(p[3]);
    };
    if (!emit(mix([](const Point& at) { return at.x; }), mix([](const Point& at) { return at.y; }))) return true;
  }
  emit(p.back().x, p.back().y);
  return true;
}

}  // namespace passo
