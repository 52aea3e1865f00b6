#include "row_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace passo {
namespace {

// What the rounding of a program may lower an arc by, mm.
constexpr double rounding = 1.5e-4;

class RowFitter {
 public:
  RowFitter(MoveWriter& writer, const NodeLattice& lattice, const NodeRun& run, double tolerance)
      : writer_(writer),
        lattice_(lattice),
        run_(run),
        tolerance_(tolerance),
        is_along_x_((run.step_x != 0) != lattice.turned),
        pitch_(is_along_x_ ? lattice.pitch_x : lattice.pitch_y),
        ahead_(run.step_x + run.step_y) {}

  void cut() {
    const std::size_t last = run_.heights.size() - 1;
    for (std::size_t begin = 0; begin < last;) {
      const LineReach line = line_from(begin);
      std::size_t end = line.end;
      std::optional<CarvedCut> best;
      // An arc must reach so much farther that it saves a line.
      std::size_t beyond = last + 1;
      std::size_t next = std::max(begin + 4, line.end + (line.end - begin));
      while (next < beyond) {
        if (const std::optional<CarvedCut> arc = arc_to(begin, next)) {
          best = arc;
          end = next;
          next = std::min(begin + 2 * (end - begin), last);
          if (end == last) break;
        } else {
          beyond = next;
        }
      }
      while (best && end + 1 < beyond) {
        const std::size_t middle = (end + beyond) / 2;
        if (const std::optional<CarvedCut> arc = arc_to(begin, middle)) {
          best = arc;
          end = middle;
        } else {
          beyond = middle;
        }
      }
      if (best) {
        writer_.arc_to(*best);
      } else {
        writer_.cut_to(place(line.end, line.height));
      }
      begin = end;
    }
  }

 private:
  struct LineReach {
    std::size_t end = 0;
    std::int64_t height = 0;
  };
  struct Curvatures {
    double least = 0;
    double most = 0;
  };

  double height() const { return static_cast<double>(writer_.place().z) / carved_units; }
  CarvedPlace place(std::size_t i, std::int64_t z) const { return lattice_.at(run_.column_at(i), run_.row_at(i), z); }

  LineReach line_from(std::size_t begin) const {
    LineReach reach;
    fit_line(run_.heights, begin, height(), tolerance_, [&](std::size_t end, std::int64_t z) { reach = {end, z}; });
    return reach;
  }

  // The arc's end, seen from its begin: along the way, and up.
  struct Chord {
    double along = 0;
    double up = 0;
    double length() const { return std::hypot(along, up); }
  };
  // Of the circle through both ends and a third point; above 0 where that lies above the chord.
  static double curvature(const Chord& chord, double length, double along, double up) {
    const double cross = chord.along * up - chord.up * along;
    return 2 * cross / (std::hypot(along, up) * length * std::hypot(chord.along - along, chord.up - up));
  }
  // `raised`: how much higher than the nodes the arc must be there.
  std::optional<Curvatures> curvatures(std::size_t begin, std::size_t end, const Chord& chord, double raised) const {
    Curvatures range{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    const double length = chord.length();
    const double from = height();
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double along = pitch_ * static_cast<double>(i - begin);
      const double up = static_cast<double>(run_.heights[i]) - from;
      range.least = std::max(range.least, curvature(chord, length, along, up + raised));
      range.most = std::min(range.most, curvature(chord, length, along, up + tolerance_ - rounding));
      if (range.least > range.most) return std::nullopt;
    }
    return range;
  }

  std::optional<CarvedCut> arc_to(std::size_t begin, std::size_t end) const {
    const double from = height();
    const std::int64_t to = carved_height(static_cast<double>(run_.heights[end]) + tolerance_ / 2);
    const Chord chord{pitch_ * static_cast<double>(end - begin), static_cast<double>(to) / carved_units - from};
    std::optional<Curvatures> range = curvatures(begin, end, chord, rounding);
    if (!range) return std::nullopt;
    double bend = range->least;
    if (bend < 0) {
      // In a valley the arc hangs below the chord from node to node.
      const double steep = 1 + chord.up * chord.up / (chord.along * chord.along);
      const double hangs = -bend * pitch_ * pitch_ * steep / 4;
      range = curvatures(begin, end, chord, rounding + hangs);
      if (!range) return std::nullopt;
      bend = range->least;
    }
    return arc_of(end, to, chord, bend);
  }

  std::optional<CarvedCut> arc_of(std::size_t end, std::int64_t to, const Chord& chord, double bend) const {
    const double length = chord.length();
    const double sine = bend * length / 2;
    constexpr double least_bend = 1.0 / 1000;  // of a larger radius: a line
    constexpr double most_sine = 0.7;
    constexpr double steepest = 1.2;  // radians
    if (std::abs(bend) < least_bend || std::abs(sine) > most_sine) return std::nullopt;
    const double direction = std::atan2(chord.up, chord.along);
    const double half = std::asin(sine);
    if (std::abs(direction) + std::abs(half) > steepest) return std::nullopt;
    // From the chord's middle to the centre: downwards for a hill.
    const double radius = 1 / std::abs(bend);
    const double away = std::sqrt(radius * radius - length * length / 4) * (bend > 0 ? -1 : 1);
    const double centre_along = chord.along / 2 - away * chord.up / length;
    const double centre_up = chord.up / 2 + away * chord.along / length;
    CarvedCut arc{.kind = is_along_x_ ? CarvedCut::Kind::arc_zx : CarvedCut::Kind::arc_yz,
                  .counterclockwise = (bend > 0) == ((ahead_ > 0) == is_along_x_),
                  .from = writer_.place(),
                  .to = place(end, to),
                  .centre = writer_.place()};
    (is_along_x_ ? arc.centre.x : arc.centre.y) += std::llround(centre_along * ahead_ * carved_units);
    arc.centre.z += std::llround(centre_up * carved_units);
    return is_slow(arc, direction, half) ? std::nullopt : std::optional(arc);
  }

  // Whether lines, each at its own feed, would take less time. `half`: of the angle that a hill turns.
  bool is_slow(const CarvedCut& arc, double direction, double half) const {
    const auto per_way = [&](double angle) { return 1 / writer_.feed_down(std::max(0.0, -std::sin(angle))); };
    const double lines = (per_way(direction + half) + 4 * per_way(direction) + per_way(direction - half)) / 6;
    return 1 / writer_.feed_down(steepest_down(arc)) > 1.1 * lines;
  }

  MoveWriter& writer_;
  const NodeLattice& lattice_;
  const NodeRun& run_;
  double tolerance_;
  bool is_along_x_;
  double pitch_;
  int ahead_;
};

}  // namespace

void cut_run_with_arcs(MoveWriter& writer, const NodeLattice& lattice, const NodeRun& run, double tolerance) {
  RowFitter(writer, lattice, run, tolerance).cut();
}

}  // namespace passo
