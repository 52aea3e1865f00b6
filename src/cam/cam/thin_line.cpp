#include "thin_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "flat_vector.hpp"

namespace passo {

DrawnRing thinned(const DrawnRing& points, double tolerance_nm) {
  std::vector<bool> stays(points.size());
  stays.front() = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const FlatVector way = from_to(points[first], points[last]);
    const double length = std::hypot(way.x, way.y);
    double farthest = tolerance_nm;
    std::size_t at = last;
    for (std::size_t i = first + 1; i < last; ++i) {
      const FlatVector off = from_to(points[first], points[i]);
      const double along = length > 0 ? dot(off, way) / length : 0;
      const bool is_beside = along >= 0 && along <= length && length > 0;
      const double away = is_beside    ? std::abs(cross(off, way)) / length
                          : along <= 0 ? std::hypot(off.x, off.y)
                                       : distance_nm(points[i], points[last]);
      if (away > farthest) at = i;
      farthest = std::max(farthest, away);
    }
    if (at == last) continue;
    stays[at] = true;
    open.emplace_back(first, at);
    open.emplace_back(at, last);
  }
  DrawnRing thin;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (stays[i]) thin.push_back(points[i]);
  }
  return thin;
}

DrawnRing thinned_ring(const DrawnRing& ring, double tolerance_nm) {
  DrawnRing points = ring;
  points.push_back(ring.front());
  DrawnRing thin = thinned(points, tolerance_nm);
  thin.pop_back();
  return thin;
}

}  // namespace passo
