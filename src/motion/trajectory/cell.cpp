#include "cell.hpp"

#include <algorithm>
#include <cmath>

#include "arithmetic.hpp"

#include "passo/geometry/curve_derivatives.hpp"

namespace passo {
namespace {

// The greatest turn of the path in one cell, in radians. The slack taken off the limits grows with its square: on an
// arc it is about (3/4) turn², on a cubic about twice that, because the bend changes too.
constexpr double turn_a_cell_of_arc = 0.04;
// For an arc where the feed exceeds an axis's velocity. The speed that the axis allows goes up and down as the arc
// turns, and the least speed in a cell counts for all of the cell.
constexpr double turn_a_cell_of_fast_arc = 0.01;
constexpr double turn_a_cell_of_cubic = 0.025;
// Where turning lowers the speed, the motion is at some limit nearly everywhere. What an axis can add along the path
// changes as the path turns, and the least of that in a cell counts for all of the cell. So the time lost grows with
// the turn of a cell: at most 1.9 % in 3,000 random programs with the turns above, 1.0 % with half of them.
constexpr double share_of_slow_turn = 0.5;
// Turning lowers the speed if at the top speed it would take this many times the acceleration along the path.
constexpr double slow_turning = 2;
// Where the axes are uneven, a turn changes the demand of the weak axis as much as the strong axis speeds up along the
// path. So cells turn less as the limits differ by more than this factor, down to a part.
constexpr double even_enough = 1.5;
constexpr double least_part_of_turn = 1.0 / 4;
// An axis that moves by less than this share of the way neither drives the path nor holds it back.
constexpr double hardly_moves = 0.01;
// The greatest share of an axis's limit that is taken off for what happens between the ends of a cell.
constexpr double most_slack = 0.5;
constexpr double cheap_slack = 0.02;  // for accelerations along the path that few cells need

// The switch from speeding up to braking comes at the end of some cell. At the ends of an arc, where motion is slow, a
// cell is no longer than this share of the braking way from full speed. From there the cells grow to this size, or to a
// share of the arc if that is longer.
constexpr double braking_share = 1.0 / 64;
constexpr double length_share = 1.0 / 128;
constexpr double growth = 2;
// Dense programs are made of short cubics, and motion has hardly time to change its speed in one. Finer cells take time
// to plan, and gain less than 0.01 % of the motion.
constexpr double length_share_of_cubic = 1.0 / 24;
// About half a cell is lost where an arc is fastest between two slow ends.
constexpr double least_cells_of_arc = 32;

// Where limits fall with the speed: the greatest change of speed in a cell, as a share of the top speed.
constexpr double speed_share = 1.0 / 64;
constexpr double most_graded = 10'000;  // cells of a segment
// A cubic that is shorter than this many braking ways sees only a part of a change of speed, and has fewer cells.
constexpr double short_for_braking = 4;
constexpr double most_graded_of_short = 24;

// A feed below a limit's shoulder by this factor is planned as if the limit were constant. The override does not raise
// the speed further.
constexpr double room_for_override = 2;

// Lowers `top`, a value along the path, to what an axis with that limit can follow where it moves by `part` of the way.
// Where the product is below the limit, the quotient would not be below `top`; the product is cheaper.
void lower(double& top, double limit, double part) {
  if (!(top * part < limit)) top = std::min(top, limit / part);
}

double smallest_rest_of(double top) {
  return std::min(smallest_cell, shortest_cell * top);
}

// Writes member by member. A cell built elsewhere and copied at once would have to wait until its bytes are written.
void fill(double from, double to, Cell& cell) {
  cell.start = from;
  cell.end = to;
  cell.length = to - from;
  cell.demand_count = cell.falling_count = 0;
  cell.straight = false;
}

// The next two: the largest speed and the largest acceleration along a path that every axis can follow. `part`: the
// size of an axis's slope, or a bound of that.
template <class Axes, class Part>
double top_speed(const Axes& axes, const Part& part) {
  double top = fastest;
  for (const LimitedAxis& axis : axes) lower(top, axis.velocity, part(axis));
  return top;
}
template <class Axes, class Part>
double top_acceleration(const Axes& axes, const Part& part) {
  double top = strongest;
  for (const LimitedAxis& axis : axes) lower(top, axis.acceleration, part(axis));
  return top;
}
// The speed up to which every limit is constant.
template <class Axes, class Part>
double flat_top(const Axes& axes, const Part& part) {
  double top = infinity;
  for (const LimitedAxis& axis : axes) {
    if (axis.falling != nullptr && part(axis) > 0)
      top = std::min(top, std::sqrt(axis.falling->shoulder()) / part(axis));
  }
  return top;
}

}  // namespace

void CellPlace::allow(double entry, double exit) const {
  for (std::size_t k = 0; k < cell.demand_count; ++k) {
    AxisDemand& demand = demands[k];
    demand.limit = std::max({demand.limit, std::abs(demand.entry_x * entry + demand.entry_y * exit),
                             std::abs(demand.exit_x * entry + demand.exit_y * exit)});
  }
}

CellCutter::CellCutter(const MotionLimits& limits) : limited_(axes_with_limits(limits)) {}

std::size_t CellCutter::most_demands() const {
  const auto axes = std::ranges::count_if(limited_, [](const LimitedAxis& axis) { return axis.limits_acceleration(); });
  return static_cast<std::size_t>(axes) + 1;
}
std::size_t CellCutter::most_falling() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(limited_, [](const LimitedAxis& axis) { return axis.falling != nullptr; }));
}

void CellCutter::begin(const Segment& segment, double entry_squared, double from) {
  segment_ = &segment;
  const Curve& curve = segment.curve;
  const double length = curve.length().value();
  longest_ = shortest_ = length;
  grade_ = 0;
  const Point steepest = curve.steepest();
  moving_.clear();
  for (const LimitedAxis& axis : limited_) {
    if (axis.row.most_of(steepest) > 0) moving_.push_back(axis);
  }
  const auto steepest_of = [&](const LimitedAxis& axis) { return axis.row.most_of(steepest); };
  const double top = std::min(segment.speed.value(), top_speed(moving_, steepest_of));
  const double strongest_here = top_acceleration(moving_, steepest_of);
  const double braking = top * top / (2 * strongest_here);
  // On a short line all limits may be constant up to the highest speed that the motion can reach there.
  const double reached = std::sqrt(entry_squared + 2 * strongest_here * (length - from));
  const bool line = curve.shape() == Curve::Shape::line;
  straight_ = line;
  if (flat_top(moving_, steepest_of) < std::min(room_for_override * top, line ? reached : infinity)) {
    const bool is_short = curve.shape() == Curve::Shape::cubic && length < short_for_braking * braking;
    const double most_cells = is_short ? most_graded_of_short : most_graded;
    grade_ = std::max(speed_share * std::sqrt(braking), std::sqrt(2 * length) / most_cells);
    straight_ = false;
  }
  at_.s = from;
  if (!straight_) {
    find_shares(curve, moving_, shares_);
    find_place(curve, moving_, from, at_);
  }
  if (line) return;
  const double turning = curve.turning(steepest);
  const bool is_slow = top * top * turning > slow_turning * strongest_here * length;
  const double part = is_slow ? part_of_turn(moving_, steepest) : 1;
  const double share = is_slow ? share_of_slow_turn * part : 1;
  if (curve.shape() == Curve::Shape::arc) {
    const double turn = top < segment.speed.value() ? part * turn_a_cell_of_fast_arc : share * turn_a_cell_of_arc;
    const double by_turn = length * turn / turning;
    longest_ =
        std::min({length / least_cells_of_arc, by_turn, std::max(braking * braking_share, length * length_share)});
    // At some speed turning takes all of the acceleration. Braking from that speed takes about one radius.
    const double slowing = std::min(braking, 1 / curve.curvature());
    shortest_ = std::clamp(slowing * braking_share, longest_ / 64, longest_);
  } else {
    const double by_turn = length * std::min(1.0, share * turn_a_cell_of_cubic / turning);
    const double wanted = std::min(by_turn, std::max(braking * braking_share, length * length_share_of_cubic));
    longest_ = shortest_ = length / std::ceil(length / wanted);
  }
}

void CellCutter::next(const CellPlace& to) {
  const double length = segment_->curve.length().value();
  // Cells grow away from both ends.
  const double near_start = std::max(shortest_, at_.s * (growth - 1));
  const double left = length - at_.s;
  double size = std::min(longest_, near_start);
  if (left <= 2 * shortest_) {
    size = left <= shortest_ * 1.5 ? left : left / 2;
  } else if (size > left / 2 && longest_ > shortest_) {
    size = left / growth;
  }
  if (grade_ > 0) size = graded(size, left);
  double end = at_.s + size;
  if (length - end < size * 1e-6) end = length;
  if (straight_) {
    cut_straight(*segment_, moving_, at_.s, end, to);
    at_.s = end;
  } else {
    Place there;
    find_place(segment_->curve, moving_, end, there);
    cut_curve(*segment_, moving_, shares_, at_, there, to);
    at_ = there;
  }
}

void CellCutter::cut(const Segment& segment, double from, double to, bool straight, const CellPlace& place) const {
  if (straight) return cut_straight(segment, limited_, from, to, place);
  PerLimit<double> shares;
  Place in;
  Place out;
  find_shares(segment.curve, limited_, shares);
  find_place(segment.curve, limited_, from, in);
  find_place(segment.curve, limited_, to, out);
  cut_curve(segment, limited_, shares, in, out, place);
}

// From rest the speed grows with the root of s, so the cells grow likewise. Each end of the segment may be a rest. At
// least two cells: a single one between two rests would have no speed.
double CellCutter::graded(double size, double left) const {
  const double near_start = grade_ * (grade_ + 2 * std::sqrt(at_.s));
  const double root = std::sqrt(left);
  const double near_end = root <= 1.5 * grade_ ? left : grade_ * (2 * root - grade_);
  return std::min({size, near_start, near_end, at_.s == 0 ? left / 2 : left});
}

// Limits of rotary axes are in degrees and cannot be compared with the others.
double CellCutter::part_of_turn(const Axes& axes, const Point& steepest) {
  double weakest = strongest;
  double most = 0;
  for (const LimitedAxis& axis : axes) {
    if (!axis.limits_acceleration() || axis.is_rotary()) continue;
    if (axis.row.most_of(steepest) < hardly_moves) continue;
    weakest = std::min(weakest, axis.acceleration);
    most = std::max(most, axis.acceleration);
  }
  return most > 0 ? std::clamp(even_enough * weakest / most, least_part_of_turn, 1.0) : 1;
}
// Let n be the part of the bend at right angles to the slope. The sum of n (q' a + q'' v²) over the axes is n² v²,
// whatever a is. It is at most the sum of |n| times the limits, which bounds v.
double CellCutter::top_of_turning(const Axes& axes, const Place& place) {
  double slope_squared = 0;
  double common = 0;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (!axes[k].limits_acceleration()) continue;
    slope_squared += squared(place.slope[k]);
    common += place.slope[k] * place.bend[k];
  }
  const double share = slope_squared > 0 ? common / slope_squared : 0;
  double normal_squared = 0;
  double strength = 0;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (!axes[k].limits_acceleration()) continue;
    const double normal = place.bend[k] - share * place.slope[k];
    normal_squared += squared(normal);
    strength += std::abs(normal) * axes[k].acceleration;
  }
  return normal_squared > 0 ? strength / normal_squared : infinity;
}

void CellCutter::find_place(const Curve& curve, const Axes& axes, double s, Place& place) {
  const CurveDerivatives here = derivatives_at(curve, Mm(s));
  place.s = s;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    place.slope[k] = axes[k].row.of(here.first);
    place.bend[k] = axes[k].row.of(here.second);
  }
  place.turning = top_of_turning(axes, place);
  if (curve.shape() != Curve::Shape::arc) return;
  const Curve::ArcData& arc = curve.arc_data();
  place.around = std::hypot(here.first[arc.first], here.first[arc.second]);
}

// On an arc each derivative is the one before, turned. So its size is that of the slope in the plane, times the turn
// for each millimetre.
CellCutter::Bend CellCutter::bend_of_arc(const Curve& curve, const Place& in, const Place& out) {
  const Curve::ArcData& arc = curve.arc_data();
  const double turn = std::abs(arc.sweep) / curve.length().value();
  // A growing radius adds to every derivative; three times its share covers the binomial terms.
  const double growing = 3 * std::abs(arc.end_radius - arc.start_radius) / curve.length().value();
  const double around = growing + std::max(in.around, out.around);
  return {.third = around * turn * turn, .fourth = around * turn * turn * turn};
}

// A cubic's third derivative is constant.
void CellCutter::find_shares(const Curve& curve, const Axes& axes, PerLimit<double>& shares) {
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const AxisRow& row = axes[k].row;
    shares[k] = 0;
    if (curve.shape() == Curve::Shape::cubic) shares[k] = 6 * std::abs(row.of(curve.cubic_data().third));
    if (curve.shape() != Curve::Shape::arc) continue;
    const Curve::ArcData& arc = curve.arc_data();
    const double first = row.factor_of(arc.first);
    const double second = row.factor_of(arc.second);
    shares[k] = first == 0 ? std::abs(second) : second == 0 ? std::abs(first) : std::hypot(first, second);
  }
}

// Cuts one cell of a line, or of the rest of a line.
void CellCutter::cut_straight(const Segment& segment, const Axes& axes, double from, double to,
                              const CellPlace& place) {
  Cell& cell = place.cell;
  fill(from, to, cell);
  const Point slope = segment.curve.tangent(Mm(from));
  const auto part = [&](const LimitedAxis& axis) { return std::abs(axis.row.of(slope)); };
  const double top = std::min(top_speed(axes, part), flat_top(axes, part));
  cell.top_squared = squared(top);
  cell.smallest_rest = smallest_rest_of(top);
  cell.acceleration = top_acceleration(axes, part);
  cell.straight = true;
}

// Turning may hide an axis's acceleration along its slope. So the acceleration along the path may be twice what the
// slope alone allows. It may be more where that takes little off the limits, up to a value below which some axis keeps
// it anyway.
CellCutter::Strength CellCutter::strength_on(const Axes& axes, const Place& in, const Place& out,
                                             const CellBounds& bounds, double slope_strength) {
  const double h = out.s - in.s;
  const double most = std::min(bounds.top_squared / (2 * h), strongest);
  double strength = std::min(2 * slope_strength, most);
  const auto demand_on = [&](std::size_t k) {
    return axes[k].acceleration + bounds.fastest_squared * std::max(std::abs(in.bend[k]), std::abs(out.bend[k]));
  };
  const auto along = [&](std::size_t k) { return std::min(std::abs(in.slope[k]), std::abs(out.slope[k])); };
  const auto is_kept = [&] {
    if (!(strength < most)) return true;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      if (demand_on(k) <= strength * along(k)) return true;
    }
    return false;
  };
  if (is_kept()) return {.most = strength, .is_kept = true};
  double more = most;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const Bend& bend = bounds.bends[k];
    const double left = cheap_slack * axes[k].acceleration * 8 / (h * h) - bend.fourth * bounds.top_squared;
    if (bend.third > 0) more = std::min(more, left / (5 * bend.third));
    if (along(k) > 0) more = std::min(more, demand_on(k) / along(k));
  }
  strength = std::max(strength, more);
  return {.most = strength, .is_kept = is_kept()};
}

// Between the ends the demand f(s) = q' a + q'' v² has f'' = q'''' v² + 5 a q''', since (v²)' = 2a. So f exceeds the
// larger of its end values by at most h²/8 times the largest |f''|. That much is taken off the limit.
void CellCutter::cut_curve(const Segment& segment, const Axes& axes, const PerLimit<double>& shares, const Place& in,
                           const Place& out, const CellPlace& place) {
  Cell& cell = place.cell;
  fill(in.s, out.s, cell);
  const double h = out.s - in.s;
  const double eighth = h * h / 8;
  const bool is_arc = segment.curve.shape() == Curve::Shape::arc;
  const Bend of_arc = is_arc ? bend_of_arc(segment.curve, in, out) : Bend{};
  PerLimit<Bend> bends;
  PerLimit<double> steepest;
  double top = fastest;
  double slope_strength = strongest;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    bends[k] = is_arc ? Bend{shares[k] * of_arc.third, shares[k] * of_arc.fourth} : Bend{shares[k], 0};
    const double slope_in = std::abs(in.slope[k]);
    const double slope_out = std::abs(out.slope[k]);
    steepest[k] = std::max(slope_in, slope_out) + eighth * bends[k].third;
    lower(top, axes[k].velocity, steepest[k]);
    lower(slope_strength, axes[k].acceleration, std::min(slope_in, slope_out));
  }
  cell.top_squared = top * top;
  cell.smallest_rest = smallest_rest_of(top);
  // Between the ends, v² lies between its values at the ends.
  double top_squared = std::min(top * top, std::max(in.turning, out.turning));
  const double fastest_squared = std::min(top_squared, squared(room_for_override * segment.speed.value()));
  const Strength own_strength = strength_on(
      axes, in, out, {.bends = bends, .top_squared = top_squared, .fastest_squared = fastest_squared}, slope_strength);
  double strength = own_strength.most;
  const auto slack_of = [&](const Bend& bend) {
    return eighth * (bend.fourth * top_squared + 5 * strength * bend.third);
  };
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (slack_of(bends[k]) <= most_slack * axes[k].acceleration) continue;
    // The cell is too coarse for this speed: go slower.
    top_squared = most_slack * axes[k].acceleration / (eighth * (bends[k].fourth + 5 * bends[k].third / (2 * h)));
    strength = std::min(strength, top_squared / (2 * h));
    cell.top_squared = std::min(cell.top_squared, top_squared);
  }
  cell.acceleration = strength;

  for (std::size_t k = 0; k < axes.size(); ++k) {
    const LimitedAxis& axis = axes[k];
    const double steep = steepest[k];
    const double bend_in = in.bend[k];
    const double bend_out = out.bend[k];
    if (!axis.limits_acceleration() || (steep == 0 && bend_in == 0 && bend_out == 0)) continue;
    const double slack = slack_of(bends[k]);
    const double slope_in = in.slope[k] / (2 * h);
    const double slope_out = out.slope[k] / (2 * h);
    place.demands[cell.demand_count++] = {.entry_x = bend_in - slope_in,
                                          .entry_y = slope_in,
                                          .exit_x = -slope_out,
                                          .exit_y = bend_out + slope_out,
                                          .limit = axis.acceleration - slack};
    if (axis.falling == nullptr || !(squared(steep) * top_squared > axis.falling->shoulder())) continue;
    // w = q'² v² bends by w'' = 2 (q''² + q' q''') v² + 8 q' q'' a.
    const double second = std::max(std::abs(bend_in), std::abs(bend_out)) + h * bends[k].third;
    const double bending = 2 * (second * second + steep * bends[k].third) * top_squared + 8 * steep * second * strength;
    place.falling[cell.falling_count++] = {.curve = axis.falling,
                                           .demand = static_cast<std::uint32_t>(cell.demand_count - 1),
                                           .entry_weight = squared(in.slope[k]),
                                           .exit_weight = squared(out.slope[k]),
                                           .slack = slack,
                                           .slack_of_fall = eighth * bending};
  }
  if (!own_strength.is_kept) {
    // Where speeding up cancels the turning of all axes that move, the demands may hide even more acceleration. This is
    // its limit.
    const double half = 1 / (2 * h);
    place.demands[cell.demand_count++] = {
        .entry_x = -half, .entry_y = half, .exit_x = -half, .exit_y = half, .limit = strength};
  }
}

}  // namespace passo
