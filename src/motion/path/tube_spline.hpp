// TubeSpline: a smoothed section. It is a cubic B-spline with the least bending that the tolerance tube around the path
// allows.
//
// The parameter t is s, except where the knots' rates are below 1 (Pace). The knots t[0] to t[n-1] are on the path;
// beyond the ends the distances are mirrored. The control points are C[-1] to C[n]. At each knot
//
//     p   = value[0] C[k-1] + value[1] C[k] + value[2] C[k+1],   and likewise p' (slope) and p'' (bend).
//
// The first and the last three control points are those of the path's own Taylor polynomial (blossoms), so position,
// tangent and second derivative are continuous with the adjacent exact pieces. Sweeps move the other control points,
// one after the other, to the minimum of a sum over the knots (a Gauss-Seidel step). A control point moves only as far
// as the deviation from the path stays within the tube, at the knots and in the middles between them.
//
// Where a section begins or ends at a stop, its direction there is free: the sweeps also move the control point next to
// the end, and the one beyond the end moves by the same distance the other way. Position and second derivative stay.
//
//   least bending:  6 sweeps for |p''|² times the knots' weight and distance, then 4 for the fourth powers of each
//                   axis' p'' instead of |p''|², and in even rows of corners 14 for the eighth powers
//   slow bending:   12 sweeps for |p''|², then 9 for |p'''|². Every third of these slides along the tube where the tube
//                   stops a control point. In even rows of corners: 5 for |p'''|², 4 for the fourth powers of each
//                   axis' p''' and 12 for the eighth, where p''' counts in multiples of its root mean square around the
//                   span. So each corner counts, not only those where the path bends most.
//
// Each sweep runs four control points behind the previous sweep, because nearer control points would influence each
// other. So the result is the same as that of sweeps over the whole section. Only a window of `window` knots is kept,
// for a section of any length. The deviations are updated, not recomputed: moving a control point by d changes them at
// seven points by known multiples of d.
//
// After the sweeps each span is checked completely (check()), and corrected if it would leave the tube. Time: 0.7 µs
// per knot, 1.3 µs for slow bending.
#pragma once

#include <array>
#include <cstdint>

#include "knot_placer.hpp"
#include "pace.hpp"
#include "relaxation.hpp"

namespace passo {

class TubeSpline {
 public:
  struct Sweeps {
    int first = 0;  // for |p''|²
    int all = 0;    // where the corners are not alike
    // In even rows of corners:
    int before_fourth = 0;
    int before_eighth = 0;
    int even = 0;  // all
  };
  static constexpr Sweeps least_bending_sweeps{
      .first = 6, .all = 10, .before_fourth = 6, .before_eighth = 10, .even = 24};
  static constexpr Sweeps slow_bending_sweeps{
      .first = 12, .all = 21, .before_fourth = 17, .before_eighth = 21, .even = 33};
  static constexpr int checks = 12;            // rounds: correcting a span pushes its neighbours outwards
  static constexpr std::int64_t window = 256;  // knots; a power of two

  TubeSpline(const RunReader& reader, Smoothness smoothness)
      : reader_(reader),
        bends_slowly_(smoothness == Smoothness::slow_bending),
        sweeps_(bends_slowly_ ? slow_bending_sweeps : least_bending_sweeps) {}

  // Adds the knots of a section, at least four, and then its end. After the end, every span must be returned before
  // more knots are added.
  void add(const Knot& knot);
  void close();

  // A finished span between two knots.
  struct End {
    Knot knot;
    double t = 0;
    Point place;
    Point tangent;
    double deviation = 0;  // mm
  };
  struct Span {
    End from;
    End to;
    bool in_tube = true;  // proven to be in the tube
    bool goes_on = true;  // continues into a span in the tube, or ends the section
  };
  [[nodiscard]] bool next(Span& span);

 private:
  using Three = std::array<double, 3>;  // factors of the control points before, at and after a knot
  // A knot, and the span from this knot to the next.
  struct Site {
    Knot knot;
    double t = 0;
    Pace pace;        // of the span
    Point place;      // P at the knot
    Point mid_place;  // P in the middle of the span
    Three value{};
    Three slope{};
    Three bend{};
    double tube = 0;                // around the span
    double bend_of_path = 0;        // maximum |P''| in the span
    std::array<double, 2> slack{};  // maximum distance of the path's vertices from the chord, in each half of the span
    double per_change = 0;          // 1 / (the mean |p'''|² around the span times its width²); 0: not yet known
    bool checked = false;
  };
  Site& at(std::int64_t k) { return sites_[static_cast<std::size_t>(k + 1) & (window - 1)]; }
  const Site& at(std::int64_t k) const { return sites_[static_cast<std::size_t>(k + 1) & (window - 1)]; }
  bool is_free(std::int64_t k) const { return k >= 2 && !(closed_ && k > knots_ - 3); }
  // Whether it is the control point next to an end whose direction is free.
  bool turns_end(std::int64_t k) const {
    return (k == 1 && begins_freely_) || (closed_ && k == knots_ - 2 && ends_freely_);
  }
  bool moves(std::int64_t k) const { return is_free(k) || turns_end(k); }
  bool has_span(std::int64_t k) const { return k >= 0 && !(closed_ && k > knots_ - 2); }
  double knot_at(std::int64_t k) const;

  // The path in a span.
  void begin_site(const Knot& knot);
  const Piece& piece(std::uint64_t number) const { return reader_.pieces()[number]; }
  Point path_at(std::uint64_t& number, double s) const;
  void survey(Site& site, const Site& next);
  double slack_between(double from, const Point& from_place, double to, const Point& to_place, std::uint64_t first,
                       std::uint64_t last) const;

  // Initialises a control point before the sweeps.
  void begin_control(std::int64_t k);
  Point first_control(std::int64_t k) const;
  Point taylor_control(std::int64_t knot, std::int64_t k) const;
  Point secant_control(std::int64_t k) const;
  void find_factors(std::int64_t k);
  void find_steps(std::int64_t k);
  void find_change_pull(std::int64_t k, Relaxation::Factors& factors) const;
  void measure_knot(std::int64_t k);
  void measure_middle(std::int64_t k);

  // Sweeps.
  void advance();
  void relax(std::int64_t k, int sweep);
  template <std::size_t axes>
  void step(std::int64_t k, int sweep);
  template <std::size_t axes, Relaxation::Power power>
  void step_in_even_row(std::int64_t k, int sweep);
  template <Relaxation::Power power>
  Relaxation::Four weights_in_even_row(std::int64_t k);
  double mean_change_around(std::int64_t k) const;
  void move(std::int64_t k, const Point& step);
  void turn_end(std::int64_t k, const Point& step);

  // Checks.
  struct SpanForm {  // p - P at the first knot + slope u + bend u²/2 + change u³/6
    Point off;
    Point slope;
    Point bend;
    Point change;
  };
  struct Place {
    double along = 0;  // t in the span
    Point off;         // p - P
    Point off_bend;    // p'' - P''
  };
  struct Worst {
    double excess = 0;  // mm outside the tube; at most 0: inside
    double along = 0;
    Point off;
  };
  Point slope_at(std::int64_t k) const;
  SpanForm form_of(std::int64_t k) const;
  static Place place_in(const Site& site, const SpanForm& form, const Piece& path, double u);
  static Worst worse_between(const Place& from, const Place& to, const Piece& path, const Pace& pace);
  Worst worst_of(std::int64_t k) const;
  Worst worst_in_parts(std::int64_t k, int parts) const;
  bool is_in_tube(std::int64_t k) const;
  void check(std::int64_t k);
  void push_back(std::int64_t k, const Worst& worst);
  std::array<double, 4> weights_at(std::int64_t k, double along) const;
  End end_at(std::int64_t k) const;

  const RunReader& reader_;
  const bool bends_slowly_;
  const Sweeps sweeps_;
  std::array<Site, window> sites_;
  Relaxation relaxation_;
  std::int64_t knots_ = 0;
  std::int64_t controls_ = -1;  // the next control point to initialise
  std::int64_t taken_ = 0;      // the number of spans returned
  bool closed_ = false;
  bool wide_ = false;      // axes other than X, Y and Z move too
  bool has_even_ = false;  // knots in even rows
  bool begins_freely_ = false;
  bool ends_freely_ = false;
};

}  // namespace passo
