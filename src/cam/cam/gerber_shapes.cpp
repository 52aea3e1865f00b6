#include "gerber_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

using std::numbers::pi;

double cross(DrawnPoint origin, DrawnPoint a, DrawnPoint b) {
  const auto ax = static_cast<double>(a.x.count - origin.x.count);
  const auto ay = static_cast<double>(a.y.count - origin.y.count);
  const auto bx = static_cast<double>(b.x.count - origin.x.count);
  const auto by = static_cast<double>(b.y.count - origin.y.count);
  return ax * by - ay * bx;
}

// Adds an arc with both of its ends.
void add_round(DrawnRing& ring, Offset centre, double radius, double first, double sweep) {
  const std::size_t chords = chords_of_arc(radius, sweep);
  for (std::size_t i = 0; i <= chords; ++i) {
    const double angle = first + sweep * static_cast<double>(i) / static_cast<double>(chords);
    ring.push_back(rounded({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)}));
  }
}

}  // namespace

DrawnPoint rounded(Offset place) {
  const auto farthest = static_cast<double>(farthest_of_region.count);
  const auto whole = [&](double nm) {
    return Nanometres{nm == nm ? std::llround(std::clamp(nm, -farthest, farthest)) : 0};
  };
  return {whole(place.x), whole(place.y)};
}

Offset turned(Offset place, double radians) {
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  return {place.x * c - place.y * s, place.x * s + place.y * c};
}

DrawnRing moved(DrawnRing ring, DrawnPoint by) {
  for (DrawnPoint& point : ring) point = moved(point, by);
  return ring;
}

DrawnRing turned(DrawnRing ring, double radians) {
  if (radians == 0) return ring;
  for (DrawnPoint& point : ring) {
    point = rounded(turned(Offset{static_cast<double>(point.x.count), static_cast<double>(point.y.count)}, radians));
  }
  return ring;
}

std::size_t chords_of_arc(double radius, double angle) {
  constexpr double widest = pi / 4;
  const auto tolerance = static_cast<double>(gerber_tolerance.count);
  // 1 - cos(a / 2) is a^2 / 8 so near to 0 that the cosine would be rounded to 1.
  const double ratio = tolerance / std::max(radius, 1.0);
  const double step = std::min(widest, ratio < 1e-6 ? std::sqrt(8 * ratio) : 2 * std::acos(1 - std::min(1.0, ratio)));
  return static_cast<std::size_t>(std::max(1.0, std::ceil(std::abs(angle) / step - 1e-9)));
}

DrawnRing disc_ring(Offset centre, double diameter) {
  const std::size_t corners = 4 * chords_of_arc(diameter / 2, pi / 2);
  return regular_ring(centre, diameter, corners, 0);
}

DrawnRing rectangle_ring(Offset centre, double across, double up) {
  const DrawnPoint least = rounded({centre.x - across / 2, centre.y - up / 2});
  return rectangle({least, rounded({centre.x + across / 2, centre.y + up / 2})});
}

DrawnRing obround_ring(double across, double up) {
  const double straight = std::abs(across - up) / 2;
  const double radius = std::min(across, up) / 2;
  const bool lies = across > up;
  const double first = lies ? -pi / 2 : 0;
  DrawnRing ring;
  add_round(ring, lies ? Offset{straight, 0} : Offset{0, straight}, radius, first, pi);
  add_round(ring, lies ? Offset{-straight, 0} : Offset{0, -straight}, radius, first + pi, pi);
  return ring;
}

DrawnRing regular_ring(Offset centre, double diameter, std::size_t corners, double radians) {
  DrawnRing ring;
  ring.reserve(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = radians + 2 * pi * static_cast<double>(i) / static_cast<double>(corners);
    ring.push_back(rounded({centre.x + diameter / 2 * std::cos(angle), centre.y + diameter / 2 * std::sin(angle)}));
  }
  return ring;
}

DrawnRing bar_ring(Offset from, Offset to, double width) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 0)) return {};
  const Offset side{-(to.y - from.y) / length * width / 2, (to.x - from.x) / length * width / 2};
  return {rounded({from.x - side.x, from.y - side.y}), rounded({to.x - side.x, to.y - side.y}),
          rounded({to.x + side.x, to.y + side.y}), rounded({from.x + side.x, from.y + side.y})};
}

// Andrew's monotone chain.
DrawnRing hull_of(const std::vector<DrawnRing>& rings) {
  std::vector<DrawnPoint> points;
  for (const DrawnRing& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  DrawnRing hull;
  const auto add_side = [&](auto begin, auto end) {
    const std::size_t fixed = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= fixed + 2 && cross(hull[hull.size() - 2], hull.back(), *point) <= 0) hull.pop_back();
      hull.push_back(*point);
    }
    hull.pop_back();
  };
  add_side(points.begin(), points.end());
  add_side(points.rbegin(), points.rend());
  return hull;
}

// Each edge that looks ahead goes with the line's end, every other with its begin.
DrawnRing convex_swept(const DrawnRing& convex, DrawnPoint from, DrawnPoint to) {
  if (from == to || convex.size() < 2) return moved(convex, from);
  const std::size_t size = convex.size();
  const DrawnPoint ahead{to.x - from.x, to.y - from.y};
  const auto looks_ahead = [&](std::size_t edge) {
    const DrawnPoint a = convex[edge];
    const DrawnPoint b = convex[(edge + 1) % size];
    return cross({}, ahead, {b.x - a.x, b.y - a.y}) > 0;
  };
  DrawnRing ring;
  ring.reserve(size + 2);
  bool before = looks_ahead(size - 1);
  for (std::size_t i = 0; i < size; ++i) {
    const bool after = looks_ahead(i);
    ring.push_back(moved(convex[i], before ? to : from));
    if (after != before) ring.push_back(moved(convex[i], after ? to : from));
    before = after;
  }
  return ring;
}

void append_arc(const GerberArc& arc, std::vector<DrawnPoint>& points) {
  const double from_x = static_cast<double>(arc.from.x.count) - arc.centre.x;
  const double from_y = static_cast<double>(arc.from.y.count) - arc.centre.y;
  const double from_radius = std::hypot(from_x, from_y);
  const double to_radius = std::hypot(static_cast<double>(arc.to.x.count) - arc.centre.x,
                                      static_cast<double>(arc.to.y.count) - arc.centre.y);
  const double first = std::atan2(from_y, from_x);
  const std::size_t chords = chords_of_arc(std::max(from_radius, to_radius), arc.sweep);
  for (std::size_t i = 1; i < chords; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(chords);
    const double radius = from_radius + (to_radius - from_radius) * share;
    const double angle = first + arc.sweep * share;
    points.push_back(rounded({arc.centre.x + radius * std::cos(angle), arc.centre.y + radius * std::sin(angle)}));
  }
  points.push_back(arc.to);
}

}  // namespace passo
