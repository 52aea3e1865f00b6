#include "helix_entry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "medial_axis.hpp"

namespace passo {

std::optional<Helix> find_helix(const Region& ground, double margin_nm, Nanometres cutter) {
  constexpr double usual = 0.4;  // radius, in diameters of the cutter
  constexpr double least = 0.25;
  const auto diameter = static_cast<double>(cutter.count);
  const std::optional<MedialAxis> axis = medial_axis(ground, {.tolerance_nm = 2'000});
  if (!axis) return std::nullopt;
  MedialPoint widest;
  for (const MedialPiece& piece : axis->pieces) {
    for (const MedialPoint& point : piece.points) {
      if (point.clearance > widest.clearance) widest = point;
    }
  }
  if (widest.clearance <= 0) return std::nullopt;
  const double radius = std::min(usual * diameter, widest.clearance + margin_nm);
  if (radius < least * diameter) return std::nullopt;
  return Helix{{{std::llround(widest.x)}, {std::llround(widest.y)}}, radius};
}

ClosedToolpath track_of(const Helix& helix, DrawnPoint towards, bool climb) {
  constexpr int arcs = 4;
  const double begin = std::atan2(static_cast<double>(towards.y.count - helix.centre.y.count),
                                  static_cast<double>(towards.x.count - helix.centre.x.count));
  const double sweep = (climb ? 2 : -2) * std::numbers::pi / arcs;
  std::vector<PathPoint> points;
  for (int i = 0; i < arcs; ++i) {
    const double angle = begin + i * sweep;
    points.push_back({{{helix.centre.x.count + std::llround(helix.radius * std::cos(angle))},
                       {helix.centre.y.count + std::llround(helix.radius * std::sin(angle))}},
                      std::tan(sweep / 4)});
  }
  return ClosedToolpath(points);
}

}  // namespace passo
