// ChordFitter: reconstructs a curve from its chords, with one cubic for many chords.
//
// CAM programs output a curve as short lines whose ends are rounded to the micrometre or worse. A path through these
// ends has the curvature of the rounding, not of the curve. So a run of chords is replaced by a least-squares cubic:
//
//   - no chord is farther from the cubic than nearly the tolerance, in the order of the path, and
//   - of windows of growing length, the cubic with the least misfit is taken: the part of the residuals in the next
//     polynomials, of which rounding has little (docs/smoothing.md).
//
// The deviation of a cubic from its chords is returned, and reduces the tolerance tube around it. A cubic ends well
// before the end of its window, where it crosses its chords; before a stop it ends at the chords' own end. The next
// cubic is also fitted to some chords before its start, so that both have nearly the same direction there.
// PathSmoother rounds the junction like any other. Close to a corner the chords stay unchanged. A turn that rounding
// can explain is not a corner.
//
// Only continuous lines of equal speed, kind and tolerance are fitted, and never in a thread, where the spindle is
// synchronised to s. The look-ahead is at most `most_fitted` lines. Time: each line is processed about five times,
// 0.3 µs in total.
#pragma once

#include <array>
#include <vector>

#include "line_merger.hpp"

#include "passo/base/window.hpp"

namespace passo {

class ChordFitter {
 public:
  static constexpr std::uint64_t least_fitted = 8;
  static constexpr std::uint64_t fewest_fitted = 4;  // where a curve bends too much for the least number
  static constexpr std::uint64_t most_fitted = 512;

  explicit ChordFitter(Source<PathItem>& path) : merger_(path) {}

  // Like LineMerger::next.
  [[nodiscard]] bool next(PathItem& item, double& deviation);

 private:
  struct Ahead {
    PathItem item;           // of a part of an arc: the arc from the start of the part on
    bool is_chord = false;   // a line, or a part of an arc
    bool is_inside = false;  // a part of an arc that is not its last
    Point end;               // of the chord
    double deviation = 0;
    double moved = 0;  // displacement of the chord's start by a cubic's free end
  };
  struct Vertex {
    double s = 0;          // the length of the chords up to here, along their heading
    Point way;             // vector from the start of the first chord
    double deviation = 0;  // deviation of the previous chord from the program
  };
  // The least-squares sums: of s² to s⁶, and of s, s² and s³ times the displacement.
  struct Sums {
    std::array<double, 5> powers{};
    std::array<Point, 3> moments{};

    void add(const Vertex& vertex, double weight, bool wide);
  };
  // The cubic start + parts[0] u + parts[1] u² + parts[2] u³, u from 0 to 1.
  struct Fit {
    std::size_t count = 0;     // number of chords; 0: there is no cubic
    double share = 0;          // of the chord after them that is replaced too
    double moved = 0;          // distance of the cubic's end from the chords
    bool end_is_free = false;  // otherwise the cubic ends at the last chord's end
    std::array<Point, 3> parts{};
    double window = 0;  // length of the chords that were fitted
    double length = 0;
    double deviation = 0;
    double error = 1e300;  // the misfit; a longer fit may have a little more

    Point way_at(double u) const { return (parts[0] + (parts[1] + parts[2] * u) * u) * u; }
    Point slope_at(double u) const { return parts[0] + (parts[1] * 2 + parts[2] * (3 * u)) * u; }
    // Returns the vector from the cubic to a point beside it, perpendicular to the cubic. Sets dP/du.
    template <std::size_t axes>
    std::array<double, axes> miss_at(double u, const Point& way, std::array<double, axes>& slope) const;
  };

  bool has(std::uint64_t number);
  void read_in(std::uint64_t number);
  bool is_in_row(const Segment& segment);
  void split_arc(std::uint64_t number);
  const Segment* segment_at(std::uint64_t number) const { return std::get_if<Segment>(&ahead_[number].item); }
  bool may_begin(const Segment& segment) const;
  bool goes_on_after(std::uint64_t number);
  bool continues_after(std::uint64_t number);
  bool turns_by_noise(std::uint64_t number);
  PathMode mode_after(std::uint64_t number) const;
  Point way_of(std::uint64_t number) const { return ahead_[number].end - segment_at(number)->curve.start(); }
  Point way_back(std::uint64_t number, double distance) const;
  Point way_ahead(std::uint64_t number, double distance);
  void add_chord(std::uint64_t number);
  void add_chords(std::size_t count);
  void add_what_is_behind();
  bool comes_to_a_corner();
  void stay_clear_of_the_end();
  bool extend_to(std::uint64_t count, double length);
  Fit best_fit();
  Fit fit_of_fewest();
  Fit solved(bool end_is_free) const;
  bool passes(Fit& fit) const;
  template <std::size_t axes>
  bool passes_in(Fit& fit) const;
  template <std::size_t axes>
  double farthest_inside(const Fit& fit, const Vertex& before, const Vertex& vertex, double parts) const;
  void cut(Fit& fit) const;
  template <std::size_t axes>
  void cut_in(Fit& fit) const;
  void remember(std::uint64_t end);
  void move_start(std::uint64_t number, const Point& start);
  void emit_as_is(PathItem& item, double& deviation);
  void emit_cubic(const Fit& fit, PathItem& item, double& deviation);

  LineMerger merger_;
  Window<Ahead> ahead_;
  bool at_end_ = false;
  // The number of the last items that are short pieces of a curve. For the last one, also its length, its direction at
  // its end, and its centre, if it is an arc.
  struct Row {
    int count = 0;
    double length = 0;
    Point tangent;
    std::array<double, 2> center{};
  };
  Row row_;
  // The mode of the junction before the next item.
  PathMode mode_before_ = PathMode::exact_stop;
  double tolerance_before_ = 0;
  double since_corner_ = 1e9;  // mm; large after a stop
  // The starts of the last chords, and how far back (mm) the next cubic is fitted to them too.
  std::vector<Point> behind_;
  double overlap_ = 0;
  double last_window_ = 0;
  // Of the current chords.
  double tolerance_ = 0;
  std::uint64_t known_to_ = 0;  // each chord before this one is known to go on into the next one
  Point first_heading_;
  Point heading_;  // the mean direction of the last chords, times its distance
  std::vector<Vertex> vertices_;
  bool wide_ = false;  // axes other than X, Y and Z move too
  Sums sums_;          // without the last vertex
  double last_chord_ = 0;
};

}  // namespace passo
