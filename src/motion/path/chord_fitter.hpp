// ChordFitter: the chords of a curve become the curve again, a cubic for many chords.
//
// CAM programs write a curve as short lines whose ends are rounded to the micrometre or worse. A path through these
// ends bends as the rounding does, not as the curve does. So a run of chords is replaced by the cubic of least squares,
// for as many chords as the cubic passes closely enough:
//
//   - no chord is farther from the cubic than a share of the tolerance, and
//   - the misfit is that of rounding. The mean product of neighbouring residuals is about 0 for rounding. Where the
//     cubic is not the curve, it is the square of the misfit.
//
// What a cubic deviates from its chords is told as its deviation, and is missing from the tube around it. Neighbouring
// cubics meet at a place that the first one chooses; before a rest a cubic ends at the chords' own end. Where
// directions differ, PathSmoother rounds the junction like any other. Close to a corner the chords stay as they are.
//
// Only continuous lines of equal speed, kind and tolerance are fitted, and never in a thread: there s is what the
// spindle is followed by. Looks at most `most_fitted` lines ahead. Time: each line is taken into account about three
// times, some 100 ns altogether.
#pragma once

#include <array>
#include <vector>

#include "line_merger.hpp"

#include "passo/base/window.hpp"

namespace passo {

class ChordFitter {
 public:
  static constexpr std::uint64_t least_fitted = 8;
  static constexpr std::uint64_t most_fitted = 512;

  explicit ChordFitter(Source<PathItem>& path) : merger_(path) {}

  // Like LineMerger::next.
  [[nodiscard]] bool next(PathItem& item, double& deviation);

 private:
  struct Ahead {
    PathItem item;
    double deviation = 0;
    double moved = 0;  // how far a cubic's free end has moved the line's start
  };
  struct Vertex {
    double s = 0;          // the length of the chords up to here
    Point way;             // from the start of the first chord
    double deviation = 0;  // of the chord before, from the program
  };
  // The sums of least squares, of s² to s⁶, and of s, s² and s³ times the way.
  struct Sums {
    std::array<double, 5> powers{};
    std::array<Point, 3> moments{};
  };
  // The cubic start + parts[0] u + parts[1] u² + parts[2] u³, u from 0 to 1.
  struct Fit {
    std::size_t count = 0;  // chords; 0: there is no cubic
    std::array<Point, 3> parts{};
    bool end_is_free = false;  // else the last chord's end
    double length = 0;
    double deviation = 0;
    bool misses = false;  // the curve, by more than rounding does

    Point way_at(double u) const { return (parts[0] + (parts[1] + parts[2] * u) * u) * u; }
    Point slope_at(double u) const { return parts[0] + (parts[1] * 2 + parts[2] * (3 * u)) * u; }
  };

  bool has(std::uint64_t number);
  const Segment* segment_at(std::uint64_t number) const { return std::get_if<Segment>(&ahead_[number].item); }
  bool may_begin(const Segment& segment) const;
  bool goes_on_after(std::uint64_t number);
  void add_chord(std::uint64_t number);
  void add_chords(std::size_t count);
  bool comes_to_a_corner();
  void stay_clear_of_the_end();
  Fit longest_fit();
  Fit fit(bool end_is_free) const;
  Fit solved(bool end_is_free) const;
  bool passes(Fit& fit) const;
  void emit_cubic(const Fit& fit, PathItem& item, double& deviation);

  LineMerger merger_;
  Window<Ahead> ahead_;
  bool at_end_ = false;
  // Of the junction before the next item.
  PathMode mode_before_ = PathMode::exact_stop;
  double tolerance_before_ = 0;
  double since_corner_ = 1e9;  // mm; far after a rest
  // Of the chords at hand.
  double tolerance_ = 0;
  std::vector<Vertex> vertices_;
  Sums sums_;
};

}  // namespace passo
