// Random paths for the smoother's tests, and an oracle for the deviation of a smoothed path from the programmed one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "kit/path_text.hpp"
#include "kit/stage_test.hpp"
#include <gtest/gtest.h>

#include "passo/path/path_smoother.hpp"

namespace passo::test {

inline std::vector<PathItem> smooth(const std::vector<PathItem>& path,
                                    Smoothness smoothness = Smoothness::least_bending) {
  ListSource<PathItem> source(path);
  PathSmoother smoother(source, smoothness);
  return drain(smoother);
}

inline std::vector<Segment> segments_of(const std::vector<PathItem>& items) {
  std::vector<Segment> segments;
  for (const PathItem& item : items) {
    if (const auto* segment = std::get_if<Segment>(&item)) segments.push_back(*segment);
  }
  return segments;
}

inline double euclid(const Point& a) {
  double sum = 0;
  for (const double value : a.values) sum += value * value;
  return std::sqrt(sum);
}
inline double apart(const Point& a, const Point& b) {
  return euclid(a - b);
}

// A path, parametrised by its length. Points are found by bisection in a table, independent of the smoother.
class ByLength {
 public:
  explicit ByLength(std::vector<Segment> segments) : segments_(std::move(segments)) {
    for (const Segment& segment : segments_) ends_.push_back(length() + segment.curve.length().value());
  }
  double length() const { return ends_.empty() ? 0 : ends_.back(); }
  std::size_t index_at(double s) const {
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), s);
    return std::min(static_cast<std::size_t>(found - ends_.begin()), segments_.size() - 1);
  }
  Point at(double s) const {
    const std::size_t i = index_at(s);
    return segments_[i].curve.at(Mm(s - (i > 0 ? ends_[i - 1] : 0)));
  }
  double end_of(std::size_t i) const { return ends_[i]; }
  // Returns the range of a program line and the lines next to it.
  std::pair<double, double> around_line(std::uint32_t line) const {
    const auto found = std::ranges::lower_bound(segments_, line, {}, [](const Segment& s) { return s.source.line; });
    const auto i = std::min(static_cast<std::size_t>(found - segments_.begin()), segments_.size() - 1);
    return {i > 1 ? ends_[i - 2] : 0, ends_[std::min(i + 1, ends_.size() - 1)]};
  }
  std::size_t size() const { return segments_.size(); }
  const Segment& operator[](std::size_t i) const { return segments_[i]; }

 private:
  std::vector<Segment> segments_;
  std::vector<double> ends_;
};

struct Faults {
  double excess = -1;       // the largest excess of the deviation over the tolerance
  std::size_t gaps = 0;     // ends that differ from the next start; stops not met in order
  double tangent_jump = 0;  // the largest jump, where the path does not stop
  double bend_jump = 0;     // the jump of d²P/ds² there, relative to 1/mm and to itself
  std::string where;        // where the deviation is largest
};

// Returns the change of the unit tangent at the junction after a segment.
inline double turn_after(const ByLength& path, std::size_t k) {
  const Point in = path[k].curve.tangent(path[k].curve.length());
  const Point out = path[k + 1].curve.tangent(Mm(0));
  return apart(in * (1 / euclid(in)), out * (1 / euclid(out)));
}

// Returns the tolerance for rounding the junction after a segment. 0: the junction is a stop.
inline double junction_tolerance(const ByLength& path, std::size_t k) {
  if (k + 1 == path.size() || path[k].mode == PathMode::exact_stop) return 0;
  const double turn = turn_after(path, k);
  if (turn > 1.9999) return 0;
  if (path[k].mode == PathMode::exact_path) return turn > 0.01 ? 0 : 0.001;
  return path[k].tolerance.value();
}

// Returns the smallest tolerance that applies to each segment, from the junctions at its ends that are not stops. In
// exact path mode, a point that is straight except for rounding is not a junction, so the ends are those of the whole
// line.
inline std::vector<double> tolerances_of(const ByLength& path) {
  constexpr double straight = 1e-6;
  std::vector<double> least(path.size(), 1e9);
  for (std::size_t first = 0; first < path.size();) {
    std::size_t last = first;
    while (last + 1 < path.size() && path[last].mode == PathMode::exact_path && turn_after(path, last) < straight) {
      ++last;
    }
    double tolerance = 1e9;
    for (const std::size_t k : {first - 1, last}) {  // 0 - 1: there is no such segment
      const double here = k < path.size() ? junction_tolerance(path, k) : 0;
      if (here > 0) tolerance = std::min(tolerance, here);
    }
    for (; first <= last; ++first) least[first] = tolerance;
  }
  return least;
}

// Returns the path with an exact stop before each action.
inline ByLength by_length(const std::vector<PathItem>& items) {
  std::vector<Segment> segments;
  for (const PathItem& item : items) {
    if (const auto* segment = std::get_if<Segment>(&item)) {
      segments.push_back(*segment);
    } else if (!segments.empty()) {
      segments.back().mode = PathMode::exact_stop;
    }
  }
  return ByLength(std::move(segments));
}

struct Rest {
  double s = 0;
  Point place;
  bool asked_for = true;  // false: the path reverses, and merged lines may shift the point slightly
};

inline std::vector<Rest> rests_of(const ByLength& path) {
  std::vector<Rest> rests;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (junction_tolerance(path, k) > 0) continue;
    const bool asked_for = k + 1 == path.size() || path[k].mode == PathMode::exact_stop;
    rests.push_back({.s = path.end_of(k), .place = path[k].curve.end(), .asked_for = asked_for});
  }
  return rests;
}

// Finds the point of the programmed path that corresponds to a point of the smoothed path. Both paths have the same
// length, except for merged lines, which are up to 1 % shorter. So the search covers the range from the point without
// merging to the farthest point that merging since the last stop explains, and slightly more for spans that were cut.
// For slow bending the parameter advances faster than s at corners, so the search begins at the last point. `shift` is
// the offset of the last point found. Where the path crosses itself, the search may have found another point nearby. So
// `shift` is only a first guess, and ends at the next stop, which both paths reach.
struct LengthAlong {
  double since_rest = 0;
  double rest = 0;
  double shift = 0;

  double estimate() const { return rest + since_rest + shift; }

  // Returns the minimum of a measure over the candidate points of the path. The search covers first the neighbourhood
  // of the last point, then a wider range around it, then the `likely` points, then all. Where rotary axes turn
  // hundreds of degrees per millimetre, only the likely points are dense enough.
  template <class Measure>
  double search(const Measure& measure, double end, const std::pair<double, double>& likely) {
    constexpr double close = 1e-3;
    constexpr double beyond = 0.5;
    const double before = shift;
    for (const double step : {close, 50 * close}) {
      const double found = descend(measure, end, step);
      if (found <= 0) return found;
      shift = before;
    }
    double best = measure(std::clamp(estimate(), 0.0, end));
    best = search_between(measure, end, shift - close, shift + close, best);
    best = search_between(measure, end, before - beyond, before + beyond, best);
    const double here = rest + since_rest;
    best = search_between(measure, end, likely.first - here, likely.second - here, best);
    return search_between(measure, end, -beyond, 0.0102 * since_rest + beyond, best);
  }

 private:
  // Where the path is simple, a few steps find the point.
  template <class Measure>
  double descend(const Measure& measure, double end, double step) {
    const auto at = [&](double to) { return measure(std::clamp(rest + since_rest + to, 0.0, end)); };
    double best = at(shift);
    for (; step > 1e-9 && best > 0; step /= 2) {
      for (const double to : {shift - step, shift + step}) {
        const double here = at(to);
        if (here >= best) continue;
        best = here;
        shift = to;
      }
    }
    return best;
  }

  template <class Measure>
  double search_between(const Measure& measure, double end, double low, double high, double best) {
    constexpr int samples = 20'000;
    for (int pass = 0; pass < 3 && best > 0; ++pass) {
      const double step = (high - low) / samples;
      double best_shift = shift;
      for (int i = 0; i <= samples; ++i) {
        const double to = low + step * i;
        const double here = measure(std::clamp(rest + since_rest + to, 0.0, end));
        if (here >= best) continue;
        best = here;
        best_shift = to;
      }
      shift = best_shift;
      low = shift - 2 * step;
      high = shift + 2 * step;
    }
    return best;
  }
};

inline Faults faults_of(const std::vector<PathItem>& programmed, const std::vector<PathItem>& smoothed,
                        int samples = 40) {
  Faults faults;
  const ByLength path = by_length(programmed);
  const std::vector<double> tolerances = tolerances_of(path);
  const std::vector<Rest> rests = rests_of(path);
  auto rest = rests.begin();  // the next stop
  LengthAlong s;
  const Segment* before = nullptr;
  for (const PathItem& item : smoothed) {
    const auto* const segment = std::get_if<Segment>(&item);
    if (segment == nullptr) {
      before = nullptr;
      continue;
    }
    const Curve& curve = segment->curve;
    const double length = curve.length().value();
    if (before != nullptr) {
      const Curve& last = before->curve;
      faults.gaps += last.end() == curve.start() ? 0 : 1;
      if (before->mode != PathMode::exact_stop) {
        faults.tangent_jump = std::max(faults.tangent_jump, apart(last.tangent(last.length()), curve.tangent(Mm(0))));
        const Point bend = last.second_derivative(last.length());
        // Rounded coordinates cause rounding errors in d²P/ds² of a short curve.
        const double shortest = std::min(length, last.length().value());
        const double rounding = 1e-14 * (1 + euclid(curve.start())) / (shortest * shortest);
        const double jump = apart(bend, curve.second_derivative(Mm(0)));
        faults.bend_jump = std::max(faults.bend_jump, (jump - rounding) / (1 + euclid(bend)));
      }
    }
    before = segment;
    for (int i = 0; i <= samples; ++i) {
      const double along = length * i / samples;
      const Point place = curve.at(Mm(along));
      const auto excess_at = [&](double to) { return apart(path.at(to), place) - tolerances[path.index_at(to)]; };
      double excess = excess_at(std::min(s.estimate(), path.length()));
      if (excess > 0) excess = s.search(excess_at, path.length(), path.around_line(segment->source.line));
      s.since_rest += i < samples ? length / samples : 0;
      if (excess <= faults.excess) continue;
      faults.excess = excess;
      faults.where = "at " + std::to_string(s.estimate()) + " of\n" + to_text(*segment) + "beside\n" +
                     to_text(path[path.index_at(s.estimate())]);
    }
    // Other stops come from spans that were cut.
    if (segment->mode != PathMode::exact_stop) continue;
    const auto asked = std::find_if(rest, rests.end(), [](const Rest& any) { return any.asked_for; });
    const auto met = std::find_if(rest, rests.end(), [&](const Rest& any) { return any.place == curve.end(); });
    if (met > asked || met == rests.end()) continue;
    s = {.since_rest = 0, .rest = met->s, .shift = 0};
    rest = met + 1;
  }
  faults.gaps +=
      static_cast<std::size_t>(std::count_if(rest, rests.end(), [](const Rest& any) { return any.asked_for; }));
  return faults;
}

// Draws random paths of corners and smooth runs, tiny and long moves, arcs that begin along the path and other arcs,
// and actions.
class RandomPath {
 public:
  explicit RandomPath(Random& random) : random_(random) {}

  double merge_share = 0.05;
  bool rotary = true;

  std::vector<PathItem> draw(std::size_t count) {
    while (items_.size() < count) {
      if (random_.chance(0.1)) tolerance_ = std::exp(random_.between(-8, -1));
      const double kind = random_.between(0, 1);
      if (kind < 0.02) {
        items_.emplace_back(Action{.kind = Action::Kind::dwell, .source = {.line = line()}});
      } else if (kind < 0.08) {
        straight_run();
      } else if (kind < 0.2) {
        random_.chance(0.5) ? smooth_run() : rounded_run();
      } else if (kind < 0.3) {
        zigzag();
      } else if (kind < 0.5) {
        arc();
      } else {
        corner();
      }
    }
    return items_;
  }

 private:
  std::uint32_t line() const { return static_cast<std::uint32_t>(items_.size() + 1); }
  double any_size() { return std::exp(random_.between(-9, 4)); }

  void add(const Curve& curve) {
    if (!curve.has_length()) return;
    const double kind = random_.between(0, 1);
    const bool rapid = random_.chance(0.1);
    const PathMode mode = kind < 0.01   ? PathMode::exact_stop
                          : kind < 0.03 ? PathMode::exact_path
                                        : PathMode::continuous;
    const double tolerance = mode == PathMode::continuous ? tolerance_ : 0;
    items_.emplace_back(Segment{.curve = curve,
                                .speed = MmPerSecond(rapid ? std::numeric_limits<double>::infinity() : feed_),
                                .rapid = rapid,
                                .mode = mode,
                                .tolerance = Mm(tolerance),
                                .merge = Mm(merge_share * tolerance),
                                .source = {.line = line()}});
    position_ = curve.end();
    direction_ = curve.tangent(curve.length());
    if (random_.chance(0.1)) feed_ = std::exp(random_.between(-1, 6));
  }
  void line_to(const Point& end) { add(Curve::line(position_, end)); }

  void corner() {
    Point end = position_;
    const double size = any_size();
    const double group = rotary ? random_.between(0, 1) : 0;
    for (const Axis axis : all_axes) {
      const bool moves = group < 0.7 ? axis <= Axis::z : group < 0.8 ? is_rotary(axis) : random_.chance(0.5);
      if (moves && random_.chance(0.7)) end[axis] += size * random_.between(-1, 1);
    }
    line_to(end);
  }

  void straight_run() {
    const Point step = xyz(random_.between(-1, 1), random_.between(-1, 1), random_.between(-0.1, 0.1)) * any_size();
    const int pieces = static_cast<int>(random_.between(2, 100));
    for (int i = 0; i < pieces; ++i) line_to(position_ + step);
  }

  // A curve in chords whose ends are rounded, as CAM programs write it; sometimes a rotary axis turns with it.
  void rounded_run() {
    const double radius = std::exp(random_.between(-1, 4));
    const double chord = std::exp(random_.between(-5, 0));
    const double grid = std::min(tolerance_ * std::exp(random_.between(-4, 0)), chord / 2);
    const double climb = random_.between(-0.3, 0.3);
    const double turn = rotary && random_.chance(0.3) ? random_.between(-20, 20) : 0;
    const double begin = random_.between(0, 6.28);
    const Point center = position_ - xyz(radius * std::cos(begin), radius * std::sin(begin));
    const int pieces = static_cast<int>(random_.between(8, 150));
    for (int i = 1; i <= pieces; ++i) {
      const double angle = chord * i / radius;
      Point end = center + xyz(radius * std::cos(begin + angle), radius * std::sin(begin + angle), climb * chord * i);
      end[Axis::a] += turn * chord * i;
      for (double& value : end.values) value = std::round(value / grid) * grid;
      line_to(end);
    }
  }

  void smooth_run() {
    double angle = random_.between(0, 6.28);
    const double size = std::exp(random_.between(-7, 0));
    const double bend = random_.between(-0.1, 0.1);
    const double noise = std::exp(random_.between(-8, -1));
    const int pieces = static_cast<int>(random_.between(2, 200));
    for (int i = 0; i < pieces; ++i) {
      angle += bend + noise * random_.between(-1, 1);
      line_to(position_ + xyz(size * std::cos(angle), size * std::sin(angle), noise * size * random_.between(-1, 1)));
    }
  }

  void zigzag() {
    const double size = any_size();
    const double height = size * std::exp(random_.between(-6, 2));
    const int pieces = static_cast<int>(random_.between(2, 30));
    for (int i = 0; i < pieces; ++i) line_to(position_ + xyz(size, i % 2 == 0 ? height : -height));
  }

  // Half of the arcs begin tangentially to the path, except for rounding in the program.
  void arc() {
    static constexpr std::array<std::array<Axis, 3>, 3> planes = {
        {{Axis::x, Axis::y, Axis::z}, {Axis::z, Axis::x, Axis::y}, {Axis::y, Axis::z, Axis::x}}};
    const auto& [first, second, through] = planes[static_cast<std::size_t>(random_.between(0, 2.999))];
    const double radius = std::exp(random_.between(-3, 4));
    const double sense = random_.chance(0.5) ? 1 : -1;
    const double sweep = sense * (random_.chance(0.1) ? 6.283185307179586 : std::exp(random_.between(-6, 2.5)));
    double start = random_.between(-3, 3);
    if (random_.chance(0.5)) {
      start = std::atan2(direction_[second], direction_[first]) - sense * 1.5707963267948966;
      if (random_.chance(0.5)) start += 1e-4 * random_.between(-1, 1);
    }
    const double growth = random_.chance(0.3) ? 1e-3 * random_.between(-1, 1) : 0;
    const double first_center = position_[first] - radius * std::cos(start);
    const double second_center = position_[second] - radius * std::sin(start);
    Point end = position_;
    end[first] = first_center + radius * (1 + growth) * std::cos(start + sweep);
    end[second] = second_center + radius * (1 + growth) * std::sin(start + sweep);
    if (random_.chance(0.3)) end[through] += any_size() * random_.between(-1, 1);
    if (rotary && random_.chance(0.2)) end[Axis::a] += any_size() * random_.between(-1, 1);
    add(Curve::arc(position_, end, first, second, first_center, second_center, sweep));
  }

  Random& random_;
  std::vector<PathItem> items_;
  Point position_;
  Point direction_ = xyz(1, 0);
  double feed_ = 30;
  double tolerance_ = 0.01;
};

class PathSmootherTest : public testing::Test {
 protected:
  Segment& add(const Curve& curve) {
    path_.emplace_back(Segment{.curve = curve,
                               .speed = MmPerSecond(50),
                               .tolerance = Mm(tolerance_),
                               .merge = Mm(tolerance_ * 0.05),
                               .source = {.line = static_cast<std::uint32_t>(path_.size() + 1)}});
    position_ = curve.end();
    return std::get<Segment>(path_.back());
  }
  Segment& go(double x, double y, double z = 0) { return add(Curve::line(position_, xyz(x, y, z))); }
  Segment& arc(double x, double y, double center_x, double center_y, double sweep) {
    return add(Curve::arc(position_, xyz(x, y), Axis::x, Axis::y, center_x, center_y, sweep));
  }
  static void expect_good(const std::vector<PathItem>& path, Smoothness smoothness = Smoothness::least_bending) {
    const Faults faults = faults_of(path, smooth(path, smoothness));
    EXPECT_LE(faults.excess, 1e-9) << faults.where;
    EXPECT_EQ(faults.gaps, 0U);
    EXPECT_LT(faults.tangent_jump, 1e-9);
    EXPECT_LT(faults.bend_jump, 1e-4);
  }
  std::vector<Segment> smoothed() { return segments_of(smooth(path_)); }
  static std::size_t cubics(const std::vector<Segment>& segments) {
    return static_cast<std::size_t>(std::ranges::count_if(
        segments, [](const Segment& segment) { return segment.curve.shape() == Curve::Shape::cubic; }));
  }
  static std::size_t stops(const std::vector<Segment>& segments) {
    return static_cast<std::size_t>(
        std::ranges::count(segments, PathMode::exact_stop, [](const Segment& segment) { return segment.mode; }));
  }

  std::vector<PathItem> path_;
  Point position_;
  double tolerance_ = 0.01;
};

}  // namespace passo::test
