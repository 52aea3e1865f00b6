#include "arc_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "flat_vector.hpp"

namespace passo {
namespace {

struct FoundArc {
  std::size_t last;  // index of the point where it ends
  double sweep;      // 0: a line
};

class ArcFinder {
 public:
  ArcFinder(const std::vector<DrawnPoint>& points, const ArcFit& fit) : points_(points), fit_(fit) {}

  // The arc that begins here and has the most chords, or the line to the next point. Each arc is proved of all its
  // points, so their number is found by leaps: twice as far each time, then half as far.
  FoundArc longest(std::size_t first) const {
    constexpr std::size_t fewest_chords = 3;
    FoundArc found{first + 1, 0};
    std::size_t next = first + fewest_chords;
    std::size_t leap = 1;
    for (bool grows = true; leap > 0; next = found.last + leap) {
      const std::optional<FoundArc> longer = next < points_.size() ? arc(first, next) : std::nullopt;
      if (longer) found = *longer;
      if (found.sweep == 0) return found;
      grows = grows && longer;
      leap = grows ? 2 * leap : leap / 2;
    }
    return found;
  }

 private:
  // The arc from one point to the other, if all points between are on it.
  std::optional<FoundArc> arc(std::size_t first, std::size_t last) const {
    const DrawnPoint a = points_[first];
    const FlatVector to_middle = from_to(a, points_[(first + last) / 2]);
    const FlatVector to_last = from_to(a, points_[last]);
    const double twice = 2 * cross(to_middle, to_last);
    if (std::abs(twice) < 1) return std::nullopt;
    const FlatVector centre = centre_of_circle(to_middle, to_last);  // from a
    const double radius = std::hypot(centre.x, centre.y);
    constexpr double widest = 1e10;    // nm; flatter is a line
    constexpr double narrowest = 1e4;  // nm; smaller arcs suffer from the last digit of a program
    if (radius > widest || radius < narrowest) return std::nullopt;
    double sweep = 0;
    FlatVector before{-centre.x, -centre.y};
    for (std::size_t i = first + 1; i <= last; ++i) {
      const FlatVector from_a = from_to(a, points_[i]);
      const FlatVector now{from_a.x - centre.x, from_a.y - centre.y};
      if (std::abs(std::hypot(now.x, now.y) - radius) > fit_.off_circle_nm) return std::nullopt;
      const double turn = std::atan2(cross(before, now), dot(before, now));
      const double off_chord = radius * (1 - std::cos(turn / 2));
      if (turn * twice <= 0) return std::nullopt;
      const bool is_of_offset = turn * fit_.rounded_turn > 0 && off_chord <= fit_.even_chord_nm;
      if (off_chord > fit_.near_chord_nm && !(is_of_offset && is_even(first, i, last))) return std::nullopt;
      sweep += turn;
      before = now;
    }
    constexpr double most = std::numbers::pi * 1.01;
    return std::abs(sweep) <= most ? std::optional(FoundArc{last, sweep}) : std::nullopt;
  }
  // Whether the chord that ends at this index is as long as that in the middle.
  bool is_even(std::size_t first, std::size_t index, std::size_t last) const {
    const std::size_t middle = (first + last) / 2;
    const double share =
        distance_nm(points_[index - 1], points_[index]) / distance_nm(points_[middle], points_[middle + 1]);
    const bool is_at_an_end = index == first + 1 || index == last;
    return is_at_an_end ? share < 1.55 : std::abs(share - 1) < 0.05;
  }

  const std::vector<DrawnPoint>& points_;
  const ArcFit& fit_;
};

}  // namespace

std::vector<PathPoint> with_arcs(const std::vector<DrawnPoint>& points, const ArcFit& fit) {
  const ArcFinder finder(points, fit);
  std::vector<PathPoint> path;
  std::size_t at = 0;
  while (at + 1 < points.size()) {
    const FoundArc arc = finder.longest(at);
    path.push_back({points[at], std::tan(arc.sweep / 4)});
    at = arc.last;
  }
  if (!points.empty()) path.push_back({points.back(), 0});
  return path;
}

}  // namespace passo
