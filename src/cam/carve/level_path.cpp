#include "level_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace passo {
namespace {

double distance_from(const FlatPlace& place, const FlatPlace& from, const FlatPlace& to) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double square = dx * dx + dy * dy;
  const double share =
      square > 0 ? std::clamp(((place.x - from.x) * dx + (place.y - from.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(place.x - from.x - dx * share, place.y - from.y - dy * share);
}

// Points that are nearly one are one.
std::vector<FlatPlace> without_doubles(const LevelLine& line) {
  constexpr double least = 2e-4;  // mm
  std::vector<FlatPlace> points;
  for (const FlatPlace& point : line.points) {
    if (points.empty() || distance_between(points.back(), point) > least) points.push_back(point);
  }
  if (points.size() > 1 && distance_between(points.back(), line.points.back()) > 0) points.back() = line.points.back();
  return points;
}

// To the left by the distance of each point, along the mean of the directions before and after it.
std::vector<FlatPlace> moved_left(const std::vector<FlatPlace>& points, bool is_closed,
                                  const std::vector<double>& distances) {
  const std::size_t count = points.size();
  std::vector<FlatPlace> moved;
  for (std::size_t i = 0; i < count; ++i) {
    FlatPlace ahead{};
    const auto add = [&](const FlatPlace& from, const FlatPlace& to) {
      const double way = distance_between(from, to);
      if (way == 0) return;
      ahead.x += (to.x - from.x) / way;
      ahead.y += (to.y - from.y) / way;
    };
    if (i > 0) add(points[i - 1], points[i]);
    if (i + 1 < count) add(points[i], points[i + 1]);
    if (is_closed && i == 0) add(points[count - 2], points[0]);
    if (is_closed && i + 1 == count) add(points[0], points[1]);
    const double size = std::hypot(ahead.x, ahead.y);
    const double share = size > 0 ? distances[i] / size : 0;
    moved.push_back({points[i].x - ahead.y * share, points[i].y + ahead.x * share});
  }
  if (is_closed) moved.back() = moved.front();
  return moved;
}

// How far a fitted path may be from each point. On a wall the map is a staircase whose steps are a cell wide, since a
// node is as high as the highest place around it: there the path may be off by a step, lest it copy the stairs.
std::vector<double> distances_of_fit(const std::vector<FlatPlace>& points, const TipSurface& surface, double near) {
  constexpr double wall = 6;  // rise over run, 80 degrees
  const double cell = std::hypot(surface.pitch_x(), surface.pitch_y());
  const double step = std::max(surface.pitch_x(), surface.pitch_y());
  std::vector<double> distances(points.size(), near);
  for (std::size_t i = 0; i < points.size() && step > near; ++i) {
    const FlatPlace& from = points[i > 0 ? i - 1 : 0];
    const FlatPlace& to = points[i > 0 ? i : 1];
    const double way = distance_between(from, to);
    if (way == 0) continue;
    const FlatPlace across{(to.y - from.y) / way * cell, (from.x - to.x) / way * cell};
    const double rise = surface.at({points[i].x + across.x, points[i].y + across.y}) -
                        surface.at({points[i].x - across.x, points[i].y - across.y});
    if (rise > wall * 2 * cell) distances[i] = step;
  }
  return distances;
}

class PathFitter {
 public:
  // `near`: how far the path may be from each point.
  PathFitter(std::vector<FlatPlace> points, std::vector<double> near, double height, const TipSurface& surface,
             const NodeLattice& lattice, const LevelPathFit& fit)
      : points_(std::move(points)),
        near_(std::move(near)),
        height_(height),
        surface_(surface),
        lattice_(lattice),
        has_arcs_(fit.has_arcs),
        looks_(fit.looks_for_gouges) {}

  static double near(const LevelPathFit& fit) { return std::max(fit.tolerance / 2, LevelLines::slack); }

  std::vector<CarvedCut> fit() {
    const std::size_t last = points_.size() - 1;
    std::vector<CarvedCut> cuts;
    CarvedPlace at = carved(points_.front());
    for (std::size_t i = 0; i < last;) {
      Reach best = farthest(i, 1, [&](std::size_t to) { return line(at, i, to); });
      if (has_arcs_ && i + 3 <= last) {
        const Reach arc = farthest(i, 3, [&](std::size_t to) { return this->arc(at, i, to); });
        // An arc that saves no line is none.
        if (arc.cut && arc.to > best.to + 1) best = arc;
      }
      if (best.cut) {
        if (!(best.cut->to == at)) cuts.push_back(*best.cut);
        i = best.to;
      } else {
        go_over(at, carved(points_[++i]), cuts);
      }
      at = cuts.empty() ? at : cuts.back().to;
    }
    return cuts;
  }

 private:
  struct Reach {
    std::size_t to = 0;
    std::optional<CarvedCut> cut = {};
  };

  CarvedPlace carved(const FlatPlace& place) const {
    return {std::llround((lattice_.x0 + place.x) * carved_units), std::llround((lattice_.y0 + place.y) * carved_units),
            carved_height(height_)};
  }
  FlatPlace flat(double x, double y) const { return {x / carved_units - lattice_.x0, y / carved_units - lattice_.y0}; }
  FlatPlace flat(const CarvedPlace& place) const {
    return flat(static_cast<double>(place.x), static_cast<double>(place.y));
  }
  bool is_free(const FlatPlace& from, const FlatPlace& to) const {
    return !looks_ || surface_.highest(from, to) <= height_ + 2 * LevelLines::slack;
  }

  // The farthest point that try_to() reaches, at least `least` points on: first twice as far each time, then between.
  template <class Try>
  Reach farthest(std::size_t from, std::size_t least, const Try& try_to) const {
    const std::size_t last = points_.size() - 1;
    Reach best{.to = from};
    std::size_t ahead = least;
    std::size_t beyond = last + 1;
    while (from + ahead < beyond) {
      if (std::optional<CarvedCut> cut = try_to(from + ahead)) {
        best = {from + ahead, cut};
        if (best.to == last) return best;
        ahead = std::min(2 * ahead, last - from);
      } else {
        beyond = from + ahead;
      }
    }
    if (!best.cut) return best;
    while (best.to + 1 < beyond) {
      const std::size_t middle = (best.to + beyond) / 2;
      if (std::optional<CarvedCut> cut = try_to(middle)) {
        best = {middle, cut};
      } else {
        beyond = middle;
      }
    }
    return best;
  }

  std::optional<CarvedCut> line(const CarvedPlace& at, std::size_t first, std::size_t last) const {
    const CarvedPlace to = carved(points_[last]);
    const FlatPlace a = flat(at);
    const FlatPlace b = flat(to);
    for (std::size_t i = first + 1; i < last; ++i) {
      if (distance_from(points_[i], a, b) > near_[i]) return std::nullopt;
    }
    if (!is_free(a, b)) return std::nullopt;
    return CarvedCut{.from = at, .to = to};
  }

  // The centre of the circle through three points.
  std::optional<FlatPlace> centre_of(const FlatPlace& a, const FlatPlace& b, const FlatPlace& c) const {
    const FlatPlace to_b{b.x - a.x, b.y - a.y};
    const FlatPlace to_c{c.x - a.x, c.y - a.y};
    const double twice = 2 * (to_b.x * to_c.y - to_b.y * to_c.x);
    const double b2 = to_b.x * to_b.x + to_b.y * to_b.y;
    const double c2 = to_c.x * to_c.x + to_c.y * to_c.y;
    if (std::abs(twice) < 1e-9) return std::nullopt;
    return FlatPlace{a.x + (to_c.y * b2 - to_b.y * c2) / twice, a.y + (to_b.x * c2 - to_c.x * b2) / twice};
  }

  std::optional<CarvedCut> arc(const CarvedPlace& at, std::size_t first, std::size_t last) const {
    const FlatPlace a = flat(at);
    const CarvedPlace to = carved(points_[last]);
    const std::optional<FlatPlace> found = centre_of(a, points_[(first + last) / 2], flat(to));
    if (!found) return std::nullopt;
    CarvedCut arc{.kind = CarvedCut::Kind::arc_xy, .from = at, .to = to, .centre = carved(*found)};
    const FlatPlace centre = flat(arc.centre);
    const double radius = distance_between(centre, a);
    constexpr double narrowest = 0.02;  // mm; smaller arcs suffer from the last digit of a program
    constexpr double widest = 2000;
    // A controller lets both ends lie on one circle but for the rounding of a program.
    constexpr double uneven = 1.5e-4;
    if (!(radius >= narrowest && radius <= widest) || std::abs(distance_between(centre, flat(to)) - radius) > uneven) {
      return std::nullopt;
    }
    double turned = 0;
    FlatPlace before = a;
    for (std::size_t i = first + 1; i <= last; ++i) {
      const FlatPlace& here = points_[i];
      if (std::abs(distance_between(centre, here) - radius) > near_[i]) return std::nullopt;
      const double cross = (before.x - centre.x) * (here.y - centre.y) - (before.y - centre.y) * (here.x - centre.x);
      const double dot = (before.x - centre.x) * (here.x - centre.x) + (before.y - centre.y) * (here.y - centre.y);
      const double turn = std::atan2(cross, dot);
      if (turn * turned < 0 || radius * (1 - std::cos(turn / 2)) > near_[i]) return std::nullopt;
      turned += turn;
      before = here;
    }
    constexpr double most = std::numbers::pi;
    if (turned == 0 || std::abs(turned) > most) return std::nullopt;
    arc.counterclockwise = turned > 0;
    return is_free_arc(arc) ? std::optional(arc) : std::nullopt;
  }

  // Along chords that are so near to the arc that CutterTable's allowance for rounding covers the rest.
  bool is_free_arc(const CarvedCut& arc) const {
    constexpr double near_arc = 2e-5;  // mm
    const CarvedSweep sweep = sweep_of(arc);
    const double chords = std::ceil(sweep.angle * std::sqrt(sweep.radius / (8 * near_arc)));
    const FlatPlace centre = flat(arc.centre);
    const FlatPlace start = flat(arc.from);
    const FlatPlace end = flat(arc.to);
    const double from = std::atan2(start.y - centre.y, start.x - centre.x);
    const double end_radius = distance_between(centre, end);
    FlatPlace before = start;
    for (double i = 1; i <= chords; ++i) {
      const double share = i / chords;
      const double angle = from + (arc.counterclockwise ? 1 : -1) * sweep.angle * share;
      const double radius = sweep.radius + (end_radius - sweep.radius) * share;
      const FlatPlace here{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
      if (!is_free(before, here)) return false;
      before = here;
    }
    return true;
  }

  void go_over(const CarvedPlace& from, CarvedPlace to, std::vector<CarvedCut>& cuts) const {
    const std::int64_t over = carved_height(surface_.highest(flat(from), flat(to)));
    CarvedPlace at = from;
    const auto go = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      const CarvedPlace next{x, y, z};
      if (!(next == at)) cuts.push_back({.from = at, .to = next});
      at = next;
    };
    go(from.x, from.y, std::max(over, from.z));
    go(to.x, to.y, std::max(over, from.z));
    go(to.x, to.y, to.z);
  }

  std::vector<FlatPlace> points_;
  std::vector<double> near_;
  double height_;
  const TipSurface& surface_;
  const NodeLattice& lattice_;
  bool has_arcs_;
  bool looks_;
};

}  // namespace

double LevelPath::length() const {
  double way = 0;
  for (const CarvedCut& cut : cuts) way += length_of(cut);
  return way;
}

LevelPath fit_level_path(const LevelLine& line, double height, const TipSurface& surface, const NodeLattice& lattice,
                         const LevelPathFit& fit) {
  std::vector<FlatPlace> points = without_doubles(line);
  if (points.size() < 2) return {};
  std::vector<double> near(points.size(), PathFitter::near(fit));
  if (fit.is_on_edge && fit.tolerance > 0) {
    near = distances_of_fit(points, surface, PathFitter::near(fit));
    // In a pit that is narrower than the tolerance, a point would come out on the other side.
    std::vector<double> aside = near;
    for (double& distance : aside) distance = std::max(distance / 2, fit.tolerance / 2);
    const std::vector<FlatPlace> moved = moved_left(points, line.is_closed, aside);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!fit.looks_for_gouges || surface.at(moved[i]) <= height + LevelLines::slack) points[i] = moved[i];
    }
  }
  PathFitter fitter(std::move(points), std::move(near), height, surface, lattice, fit);
  return {.cuts = fitter.fit(), .is_closed = line.is_closed};
}

namespace {

// The tip's heights along lines, at places that are less than a cell apart; each is that of the way to both its
// neighbours.
class WayProfile {
 public:
  WayProfile(const std::vector<CarvedCut>& lines, double least, const TipSurface& surface, const NodeLattice& lattice,
             bool is_closed, double places_of_cell) {
    const double apart = std::min(surface.pitch_x(), surface.pitch_y()) / places_of_cell;
    std::vector<double> of_way;
    for (const CarvedCut& line : lines) {
      const FlatPlace from = flat(line.from, lattice);
      const FlatPlace to = flat(line.to, lattice);
      const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(distance_between(from, to) / apart)));
      parts_.push_back(parts);
      for (std::size_t i = 0; i < parts; ++i) {
        const auto at = [&](std::size_t part) {
          const double share = static_cast<double>(part) / static_cast<double>(parts);
          return FlatPlace{from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share};
        };
        of_way.push_back(std::max(least, surface.highest(at(i), at(i + 1))));
      }
    }
    for (std::size_t i = 0; i <= of_way.size(); ++i) {
      const double before = i > 0 ? of_way[i - 1] : is_closed ? of_way.back() : of_way.front();
      const double after = i < of_way.size() ? of_way[i] : is_closed ? of_way.front() : of_way.back();
      heights_.push_back(std::nextafter(static_cast<float>(std::max(before, after)), 1.0F));
    }
  }

  const std::vector<float>& heights() const { return heights_; }
  std::size_t parts(std::size_t line) const { return parts_[line]; }

 private:
  static FlatPlace flat(const CarvedPlace& place, const NodeLattice& lattice) {
    return {static_cast<double>(place.x) / carved_units - lattice.x0,
            static_cast<double>(place.y) / carved_units - lattice.y0};
  }

  std::vector<float> heights_;
  std::vector<std::size_t> parts_;  // of each line
};

}  // namespace

LevelPath fit_following_path(const LevelLine& line, double least, const TipSurface& surface, const NodeLattice& lattice,
                             const LevelPathFit& fit) {
  std::vector<FlatPlace> points = without_doubles(line);
  if (points.size() < 2) return {};
  LevelPathFit flat = fit;
  flat.has_arcs = false;
  flat.looks_for_gouges = false;
  std::vector<double> near(points.size(), PathFitter::near(fit));
  const std::vector<CarvedCut> lines =
      PathFitter(std::move(points), std::move(near), least, surface, lattice, flat).fit();
  if (lines.empty()) return {};
  const WayProfile profile(lines, least, surface, lattice, line.is_closed, fit.places_of_cell);
  LevelPath path{.cuts = {}, .is_closed = line.is_closed};
  CarvedPlace at = lines.front().from;
  at.z = carved_height(static_cast<double>(profile.heights().front()));
  std::size_t first = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CarvedCut& way = lines[i];
    const std::size_t parts = profile.parts(i);
    const auto begin = profile.heights().begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<float> heights(begin, begin + static_cast<std::ptrdiff_t>(parts) + 1);
    fit_lines(heights, static_cast<double>(at.z) / carved_units, fit.tolerance, [&](std::size_t part, std::int64_t z) {
      const double share = static_cast<double>(part) / static_cast<double>(parts);
      CarvedPlace to{way.from.x + std::llround(static_cast<double>(way.to.x - way.from.x) * share),
                     way.from.y + std::llround(static_cast<double>(way.to.y - way.from.y) * share), z};
      path.cuts.push_back({.from = at, .to = to});
      at = to;
    });
    first += parts;
  }
  // It ends as high as it begins.
  if (line.is_closed && at.z != path.cuts.front().from.z) {
    CarvedPlace end = at;
    end.z = path.cuts.front().from.z;
    path.cuts.push_back({.from = at, .to = end});
  }
  return path;
}

void begin_near(LevelLine& line, const FlatPlace& place) {
  if (!line.is_closed) {
    // The direction of an open line is kept, and with it the side on which the stock is.
    return;
  }
  std::vector<FlatPlace>& points = line.points;
  points.pop_back();
  const auto nearest = std::min_element(points.begin(), points.end(), [&](const FlatPlace& a, const FlatPlace& b) {
    return distance_between(a, place) < distance_between(b, place);
  });
  std::rotate(points.begin(), nearest, points.end());
  points.push_back(points.front());
}

std::vector<LevelLine> parts_of(const LevelLine& line, const std::function<bool(const FlatPlace&)>& wants, double gap,
                                double least) {
  const std::size_t count = line.points.size();
  std::vector<bool> wanted(count);
  bool all = true;
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    wanted[i] = wants(line.points[i]);
    all = all && wanted[i];
    any = any || wanted[i];
  }
  if (all) return {line};
  if (!any) return {};
  LevelLine from = line;
  if (line.is_closed) {
    // It begins after a point that is not wanted, so no part goes over its end.
    const auto first = static_cast<std::ptrdiff_t>(std::find(wanted.begin(), wanted.end(), false) - wanted.begin());
    from.points.pop_back();
    wanted.pop_back();
    const std::ptrdiff_t turn = first < static_cast<std::ptrdiff_t>(from.points.size()) ? first : 0;
    std::rotate(from.points.begin(), from.points.begin() + turn, from.points.end());
    std::rotate(wanted.begin(), wanted.begin() + turn, wanted.end());
    from.points.push_back(from.points.front());
    wanted.push_back(wanted.front());
  }
  std::vector<LevelLine> parts;
  double pause = 0;
  std::vector<FlatPlace> between;
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    const FlatPlace& here = from.points[i];
    if (i > 0) pause += distance_between(from.points[i - 1], here);
    if (!wanted[i]) {
      between.push_back(here);
      continue;
    }
    if (parts.empty() || (!between.empty() && pause > gap)) {
      parts.emplace_back();
    } else {
      parts.back().points.insert(parts.back().points.end(), between.begin(), between.end());
    }
    between.clear();
    pause = 0;
    parts.back().points.push_back(here);
  }
  std::erase_if(parts, [&](const LevelLine& part) {
    double way = 0;
    for (std::size_t i = 1; i < part.points.size(); ++i) way += distance_between(part.points[i - 1], part.points[i]);
    return way < least || part.points.size() < 2;
  });
  return parts;
}

}  // namespace passo
