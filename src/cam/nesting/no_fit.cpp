#include "no_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "passo/nesting/nesting.hpp"

namespace passo::nesting {
namespace {

using ClipperLib::cInt;
using ClipperLib::Path;

Spot difference(const Spot& a, const Spot& b) {
  return {a.X - b.X, a.Y - b.Y};
}

cInt cross(const Spot& a, const Spot& b) {
  return a.X * b.Y - a.Y * b.X;
}

double distance_to_chord(const Spot& at, const Spot& from, const Spot& to) {
  const Spot along = difference(to, from);
  const Spot here = difference(at, from);
  const double length2 = static_cast<double>(along.X) * static_cast<double>(along.X) +
                         static_cast<double>(along.Y) * static_cast<double>(along.Y);
  const double dot = static_cast<double>(along.X) * static_cast<double>(here.X) +
                     static_cast<double>(along.Y) * static_cast<double>(here.Y);
  const double share = length2 > 0 ? std::clamp(dot / length2, 0.0, 1.0) : 0.0;
  return std::hypot(static_cast<double>(here.X) - share * static_cast<double>(along.X),
                    static_cast<double>(here.Y) - share * static_cast<double>(along.Y));
}

// Douglas and Peucker, without recursion. `most`: the distance of the farthest point that is left out.
Path with_fewer_corners(const Path& path, double tolerance, double& most) {
  if (path.size() < 5) return path;
  // A ring has two ends that stay: its leftmost point and the point farthest from it.
  Path ring = path;
  const auto first =
      std::ranges::min_element(ring, [](const Spot& a, const Spot& b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; });
  std::rotate(ring.begin(), first, ring.end());
  ring.push_back(ring.front());
  std::size_t far = 0;
  double farthest = -1;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Spot away = difference(ring[i], ring.front());
    const double length = std::hypot(static_cast<double>(away.X), static_cast<double>(away.Y));
    if (length > farthest) {
      farthest = length;
      far = i;
    }
  }
  std::vector<bool> stays(ring.size(), false);
  stays[0] = stays[far] = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> left = {{0, far}, {far, ring.size() - 1}};
  while (!left.empty()) {
    const auto [from, to] = left.back();
    left.pop_back();
    std::size_t at = from;
    double off = -1;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double distance = distance_to_chord(ring[i], ring[from], ring[to]);
      if (distance > off) {
        off = distance;
        at = i;
      }
    }
    if (off <= tolerance) {
      most = std::max(most, off);
      continue;
    }
    stays[at] = true;
    left.emplace_back(from, at);
    left.emplace_back(at, to);
  }
  Path fewer;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    if (stays[i]) fewer.push_back(ring[i]);
  }
  return fewer;
}

// Counterclockwise (A. M. Andrew, 1979).
Path convex_hull(Path points) {
  std::ranges::sort(points, [](const Spot& a, const Spot& b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; });
  Path hull;
  const auto add = [&hull](const Spot& point, std::size_t least) {
    while (hull.size() > least &&
           cross(difference(hull.back(), hull[hull.size() - 2]), difference(point, hull.back())) <= 0) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const Spot& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = std::next(points.rbegin()); point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

Path box_of(const Path& ring) {
  const auto [left, right] = std::ranges::minmax(ring, {}, &Spot::X);
  const auto [low, high] = std::ranges::minmax(ring, {}, &Spot::Y);
  return {{left.X, low.Y}, {right.X, low.Y}, {right.X, high.Y}, {left.X, high.Y}};
}

// As with_fewer_corners(); instead of less than four corners, the bounding box.
Path simplified(const Path& ring, double tolerance, double& most) {
  double left_out = most;
  Path fewer = with_fewer_corners(ring, tolerance, left_out);
  if (fewer.size() < 4 && ring.size() > 4) return box_of(ring);
  most = left_out;
  return fewer;
}

Polygons outer_rings(Polygons rings) {
  std::erase_if(rings, [](const Path& path) { return path.size() < 3 || !ClipperLib::Orientation(path); });
  return rings;
}

// Whether direction d lies in the turn from a to b, counterclockwise. One end is included.
enum class IncludedEnd : std::uint8_t { first, last };
bool is_between(const Spot& d, const Spot& a, const Spot& b, IncludedEnd included) {
  const auto dot = [](const Spot& p, const Spot& q) { return p.X * q.X + p.Y * q.Y; };
  const auto is_same = [&](const Spot& p, const Spot& q) { return cross(p, q) == 0 && dot(p, q) > 0; };
  const bool is_first = included == IncludedEnd::first;
  if (is_same(d, is_first ? b : a)) return false;
  if (is_same(d, is_first ? a : b)) return true;
  return cross(a, d) > 0 && cross(d, b) > 0;
}

// The convolution of two counterclockwise rings: a vertex of one and an edge of the other whose direction lies in the
// turn of the vertex. An edge counts backwards where the ring turns to the right. The edges form closed loops; their
// winding number is not zero exactly where the rings, one of them moved, overlap.
//
// Parallel edges are paired as if ring b were turned by a little to the left. Otherwise each of them would have to come
// after the other one, and the loops would not close.
class Convolution {
 public:
  Convolution(const Path& a, const Path& b) : a_(a), b_(b) {
    edges_of(a_, along_a_);
    edges_of(b_, along_b_);
    next_.resize(a_.size() * b_.size());
    pair_up(false);
    pair_up(true);
  }

  // Empty: the rings have spikes, and the edges do not close.
  Polygons loops();

 private:
  static void edges_of(const Path& ring, std::vector<Spot>& edges) {
    for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back(difference(ring[(i + 1) % ring.size()], ring[i]));
  }
  std::size_t node(std::size_t i, std::size_t j) const { return i * b_.size() + j; }
  void pair_up(bool moves_b);

  const Path& a_;
  const Path& b_;
  std::vector<Spot> along_a_;
  std::vector<Spot> along_b_;
  std::vector<std::vector<std::uint32_t>> next_;  // of each pair of vertices
};

void Convolution::pair_up(bool moves_b) {
  const std::vector<Spot>& edges = moves_b ? along_b_ : along_a_;
  const std::vector<Spot>& turns = moves_b ? along_a_ : along_b_;
  const IncludedEnd end_of_turn = moves_b ? IncludedEnd::first : IncludedEnd::last;
  for (std::size_t v = 0; v < turns.size(); ++v) {
    const Spot& before = turns[(v + turns.size() - 1) % turns.size()];
    const Spot& after = turns[v];
    const bool is_left = cross(before, after) >= 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Spot& first = is_left ? before : after;
      const Spot& last = is_left ? after : before;
      if (!is_between(edges[e], first, last, end_of_turn)) continue;
      const std::size_t end = (e + 1) % edges.size();
      std::size_t from = moves_b ? node(v, e) : node(e, v);
      std::size_t to = moves_b ? node(v, end) : node(end, v);
      if (!is_left) std::swap(from, to);
      next_[from].push_back(static_cast<std::uint32_t>(to));
    }
  }
}

Polygons Convolution::loops() {
  Polygons loops;
  for (std::size_t first = 0; first < next_.size(); ++first) {
    while (!next_[first].empty()) {
      Path loop;
      std::size_t at = first;
      do {
        if (next_[at].empty()) return {};
        const Spot& p = a_[at / b_.size()];
        const Spot& q = b_[at % b_.size()];
        loop.emplace_back(p.X + q.X, p.Y + q.Y);
        const std::size_t to = next_[at].back();
        next_[at].pop_back();
        at = to;
      } while (at != first);
      loops.push_back(std::move(loop));
    }
  }
  return loops;
}

}  // namespace

cInt steps_of(Nanometres length) {
  return std::llround(static_cast<double>(length.count) / nanometres_per_step);
}

std::size_t corner_count(const Polygons& polygons) {
  std::size_t count = 0;
  for (const Path& path : polygons) count += path.size();
  return count;
}

Polygons moved(Polygons polygons, const Spot& by) {
  for (Path& path : polygons) {
    for (Spot& at : path) at = {at.X + by.X, at.Y + by.Y};
  }
  return polygons;
}

Polygons turned(const Polygons& polygons, double degrees) {
  Polygons all = polygons;
  for (Path& path : all) {
    for (Spot& at : path) {
      const DrawnPoint point = placed(DrawnPoint{{at.X}, {at.Y}}, {.degrees = degrees});
      at = {point.x.count, point.y.count};
    }
  }
  return all;
}

Polygons grown_outside(const std::vector<DrawnRing>& outlines, double by, std::size_t most_corners) {
  constexpr double least_tolerance = 200;  // steps
  constexpr double usual_tolerance = 20'000;
  constexpr std::size_t usual_corners = 120;
  Polygons rings;
  for (const DrawnRing& ring : outlines) {
    Path path;
    for (const DrawnPoint& point : ring) path.emplace_back(steps_of(point.x), steps_of(point.y));
    if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
    rings.push_back(std::move(path));
  }
  ClipperLib::SimplifyPolygons(rings, ClipperLib::pftNonZero);
  rings = outer_rings(std::move(rings));
  Polygons fewer;
  double left_out = 0;
  for (double tolerance = least_tolerance;; tolerance *= 2) {
    fewer.clear();
    left_out = 0;
    for (const Path& ring : rings) fewer.push_back(simplified(ring, tolerance, left_out));
    const std::size_t corners = corner_count(fewer);
    // Four corners of each ring stay.
    if (corners <= usual_corners || corners <= 4 * rings.size()) break;
    if (tolerance >= usual_tolerance && corners <= most_corners) break;
  }
  // Chords of a wide tolerance may cross each other.
  ClipperLib::SimplifyPolygons(fewer, ClipperLib::pftNonZero);
  fewer = outer_rings(std::move(fewer));
  // Sharper corners than right angles are cut off. One step less: copies that fit exactly leave a place.
  constexpr double miter_limit = 1.5;
  ClipperLib::ClipperOffset offset(miter_limit);
  offset.AddPaths(fewer, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  Polygons grown;
  offset.Execute(grown, by + std::ceil(left_out) - 1);
  return outer_rings(std::move(grown));
}

Polygons no_fit_polygon(const Polygons& resting, const Polygons& moving) {
  ClipperLib::Clipper clipper;
  for (const Path& a : resting) {
    for (Path b : moving) {
      for (Spot& at : b) at = {-at.X, -at.Y};
      Polygons loops = Convolution(a, b).loops();
      // Clipper unites a quadrangle for each pair of edges. Where that would take minutes, the hulls keep their
      // distance.
      constexpr std::size_t most_quadrangles = 10'000;
      if (loops.empty() && a.size() * b.size() > most_quadrangles) {
        loops = Convolution(convex_hull(a), convex_hull(b)).loops();
        if (loops.empty()) loops = Convolution(box_of(a), box_of(b)).loops();
      } else if (loops.empty()) {
        ClipperLib::MinkowskiSum(a, b, loops, true);
        loops.push_back(moved({a}, b.front()).front());
        loops.push_back(moved({b}, a.front()).front());
      }
      clipper.AddPaths(loops, ClipperLib::ptSubject, true);
    }
  }
  Polygons all;
  clipper.Execute(ClipperLib::ctUnion, all, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return all;
}

Polygons without(const Polygons& free, const std::vector<Blocked>& blocked) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(free, ClipperLib::ptSubject, true);
  for (const Blocked& one : blocked) clipper.AddPaths(moved(*one.polygons, one.at), ClipperLib::ptClip, true);
  Polygons left;
  clipper.Execute(ClipperLib::ctDifference, left, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return left;
}

}  // namespace passo::nesting
