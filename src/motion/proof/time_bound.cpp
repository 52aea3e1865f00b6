#include "time_bound.hpp"

#include <algorithm>
#include <cmath>

#include "rounding.hpp"

namespace passo::proof {
namespace {

constexpr double turn_of_a_cell = 0.02;  // radians
// In a curve, and in a line under falling limits: so many in the distance from rest to the highest speed, and never
// fewer than the second number.
constexpr double cells_of_a_ramp = 64;
constexpr double fewest_cells = 4;
// The window, and what stays of it when its first part is played.
constexpr std::size_t most_cells = 40960;
constexpr std::size_t cells_kept = 8192;
// 1/x of a bend is known to this share of itself, and rather too small than too large.
constexpr double precision_of_bend = 1e-5;
constexpr int most_secants = 60;
// A jump of the velocity by less than this share of an axis's limit is rounding.
constexpr double rounding = 1e-6;
// The path rests where a kink may be passed only below this share of the lowest velocity limit.
constexpr double as_good_as_rest = 1e-3;
// A part of the direction smaller than this is rounding: the axis stands.
constexpr double standing = 1e-9;
// A cut nearer to a cell's end than this share of the cell is that end.
constexpr double least_part = 1e-6;
// A corner turns back if the cosine of its angle is below minus this.
constexpr double nearly_back = 0.999;
// Parts of a curve that meet but for this share of its length follow each other.
constexpr double rounding_of_parts = 1e-12;

template <class Row>
double squares_of(const Row& slope) {
  double sum = 0;
  for (const double part : slope) sum += squared(part);
  return sum;
}

}  // namespace

TimeBound::TimeBound(const ProofOptions& options, const std::vector<SpeedLimit>& limits)
    : axes_(options.axes), limits_(limits), ways_(options.axes) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    letters_.push_back(axes_[i].axis);
    ramps_.emplace_back(axes_[i], limits_[i]);
    any_falls_ |= limits_[i].falls();
    any_jumps_ |= axes_[i].start_stop > MmPerSecond(0);
  }
  find_turning_pairs();
}

void TimeBound::watch(const PlannedMove& move, const ExactCurve& curve) {
  const Segment& segment = move.segment;
  // If a curve comes in parts, the first part counts for all of it. The last one may be as short as rounding.
  const double length = curve.length();
  const double nothing = rounding_of_parts * length;
  const bool goes_on =
      move.from() > Mm(0) && length == length_ && std::abs((move.from() - reached_).value()) <= nothing;
  const bool begins_again = move.from() == Mm(0) && reached_ == Mm(0) && length == length_;
  if (!goes_on && !begins_again) add_curve(segment, curve);
  reached_ = move.to;
  length_ = length;
  if (length - move.to.value() <= nothing && segment.mode == PathMode::exact_stop) end_stretch();
}

void TimeBound::rest(Seconds dwell) {
  end_stretch();
  time_ += dwell.value();
  line_->began = time_;
}

void TimeBound::add_curve(const Segment& segment, const ExactCurve& curve) {
  const double feed = std::min(squared(segment.speed.value()), fastest);
  Place from = place_at(curve, 0, feed);
  Joint start = joint_at(from);
  double scale = 1;
  double kink = fastest;
  if (joint_) {
    scale = start.steepness > 0 ? squared(joint_->steepness / start.steepness) : 1;
    kink = kink_cap(*joint_, start);
    double slowest = fastest;
    for (const ProvenAxis& axis : axes_) slowest = std::min(slowest, axis.velocity.value());
    bool rests = kink * squared(start.steepness) < squared(as_good_as_rest * slowest);
    if (any_jumps_ && kink < std::max(start.rest_cap, joint_->rest_cap * scale)) {
      // The motion passes the kink, or stops and starts at two speeds of its own.
      start.rest_cap = std::max(start.rest_cap, kink);
      joint_->rest_cap = std::max(joint_->rest_cap, kink / scale);
      rests = true;
    }
    if (rests) {
      end_stretch(!goes_back(*joint_, start));
      scale = 1;
      kink = fastest;
    }
  }
  if (!joint_) x_ = start.rest_cap;
  add_to_line(segment, from);
  if (joint_) kink = std::min(kink, bend_cap(joint_->place, from, scale));
  const std::size_t first = cells_.size();
  const Place start_place = from;
  const double cells = cells_in(curve, from, feed);
  for (double i = 1; i <= cells; ++i) {
    const Place to = place_at(curve, curve.length() * (i / cells), feed);
    add_cells(curve, from, to, feed);
    from = to;
  }
  if (joint_) add_jumps(first, start_place);
  Cell& entry = cells_[first];
  entry.entry_scale = scale;
  entry.entry.cap = std::min({entry.entry.cap, kink, first > 0 ? cells_[first - 1].exit.cap * scale : fastest});
  joint_ = joint_at(from);
  if (cells_.size() >= most_cells) settle(cells_.size() - cells_kept);
}

// In a distance that is short compared with the ramps, all speeds are much the same, and few cells do.
double TimeBound::cells_in(const ExactCurve& curve, const Place& start, double feed) const {
  if (curve.is_line() && !any_falls_) return 1;
  double strongest = fastest;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (ramps_[i].limits() && start.slope[i] != 0)
      strongest = std::min(strongest, limits_[i].at(0) / std::abs(start.slope[i]));
  }
  const double ramps = std::min(2 * strongest * curve.length() / std::min(start.cap, feed), 1.0);
  return std::ceil(std::max({fewest_cells, cells_of_a_ramp * ramps, curve.turning() / turn_of_a_cell}));
}

// Cuts where an axis turns back, and where its q' is steepest or flattest.
void TimeBound::add_cells(const ExactCurve& curve, const Place& from, const Place& to, double feed) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const bool bend = from.bend[i] * to.bend[i] < 0;
    if (!bend && !(from.slope[i] * to.slope[i] < 0)) continue;
    const Place turn = place_of_turn(curve, from, to, i, bend);
    const double least = least_part * (to.s - from.s);
    if (turn.s - from.s < least || to.s - turn.s < least) continue;
    add_cells(curve, from, turn, feed);
    add_cells(curve, turn, to, feed);
    return;
  }
  add_cell(curve, from, to, feed);
}

// Where q'', or else q', of the axis is 0.
TimeBound::Place TimeBound::place_of_turn(const ExactCurve& curve, const Place& from, const Place& to, std::size_t axis,
                                          bool bend) const {
  const auto value_at = [&](double place) {
    const Derivatives q = curve.at(axes_[axis].axis, place);
    return bend ? q.second : q.first;
  };
  // The false position, by the Illinois method.
  double low = from.s;
  double high = to.s;
  double at_low = bend ? from.bend[axis] : from.slope[axis];
  double at_high = bend ? to.bend[axis] : to.slope[axis];
  int kept = 0;
  for (int i = 0; i < most_secants && high - low > rounding_of_parts * (to.s - from.s); ++i) {
    double s = high - at_high * (high - low) / (at_high - at_low);
    if (!(s > low && s < high)) s = (low + high) / 2;
    if (!(s > low && s < high)) break;
    const double here = value_at(s);
    if (here == 0) {
      high = s;
      break;
    }
    const bool is_before = here * at_low > 0;
    (is_before ? low : high) = s;
    (is_before ? at_low : at_high) = here;
    if (is_before && kept > 0) at_high /= 2;
    if (!is_before && kept < 0) at_low /= 2;
    kept = is_before ? 1 : -1;
  }
  Place place = place_at(curve, high, fastest);
  (bend ? place.bend : place.slope)[axis] = 0;
  return place;
}

void TimeBound::add_cell(const ExactCurve& curve, const Place& from, const Place& to, double feed) {
  const Place middle = curve.is_line() ? from : place_at(curve, (from.s + to.s) / 2, feed);
  Cell cell;
  cell.length = to.s - from.s;
  cell.cap = std::min(feed, cap_within(from, middle, to));
  cell.entry.cap = std::min(feed, from.cap);
  cell.exit.cap = std::min(feed, to.cap);
  cell.standing = squared(standing) * std::max(squares_of(from.slope), squares_of(to.slope));
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    cell.entry.slope[i] = squared(from.slope[i]);
    cell.exit.slope[i] = squared(to.slope[i]);
    // Simpson's rule, exact for cubics. A difference of places would lose the digits of a short way.
    cell.way[i] = (from.slope[i] + 4 * middle.slope[i] + to.slope[i]) * cell.length / 6;
  }
  cells_.push_back(cell);
  add_turns(curve, from, middle, to);
}

// A bend that leaves more than the feed is not looked at closely.
TimeBound::Place TimeBound::place_at(const ExactCurve& curve, double s, double feed) const {
  Place place{.s = s, .cap = fastest};
  const ExactCurve::AllDerivatives all = curve.at(letters_, s);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Derivatives& q = all[i];
    place.slope[i] = q.first;
    place.bend[i] = q.second;
    const double velocity = axes_[i].velocity.value();
    if (velocity > 0 && q.first != 0) place.cap = std::min(place.cap, squared(velocity / q.first));
  }
  if (curve.is_line()) return place;
  std::size_t pair = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j, ++pair) {
      place.turn[pair] = place.bend[i] * place.slope[j] - place.bend[j] * place.slope[i];
      place.turning[pair] = turning_at(place, {.i = i, .j = j, .place = pair}, std::min(feed, place.cap));
      if (place.turning[pair] != 0) place.cap = std::min(place.cap, 1 / std::abs(place.turning[pair]));
    }
  }
  return place;
}

// u = s̈ drops out of |q'ᵢ u + q''ᵢ x| ≤ Aᵢ and |q'ⱼ u + q''ⱼ x| ≤ Aⱼ: what is left is
// |q''ᵢ q'ⱼ − q''ⱼ q'ᵢ| x ≤ Aᵢ |q'ⱼ| + Aⱼ |q'ᵢ|. The right side falls as x grows, if a limit falls with the speed: the
// solution lies between the first x that is too large and that of the right side there. If even the latter is above
// `enough`, the former is returned.
double TimeBound::turning_at(const Place& place, const AxisPair& pair, double enough) const {
  const auto i = pair.i;
  const auto j = pair.j;
  const double turn = std::abs(place.turn[pair.place]);
  if (!ramps_[i].limits() || !ramps_[j].limits() || turn == 0) return 0;
  const auto strength = [&](double x) {
    const double speed = std::sqrt(x);
    return limits_[i].at(speed * place.slope[i]) * std::abs(place.slope[j]) +
           limits_[j].at(speed * place.slope[j]) * std::abs(place.slope[i]);
  };
  double high = strength(0) / turn;
  double low = limits_[i].falls() || limits_[j].falls() ? strength(high) / turn : high;
  if (low < enough && low < high) {
    // The false position, by the Illinois method.
    double at_low = strength(low) - turn * low;
    double at_high = strength(high) - turn * high;
    int kept = 0;
    for (int k = 0; k < most_secants && high - low > precision_of_bend * high; ++k) {
      double x = high - at_high * (high - low) / (at_high - at_low);
      if (!(x > low && x < high)) x = (low + high) / 2;
      const double here = strength(x) - turn * x;
      if (here > 0) {
        low = x;
        at_low = here;
        if (kept > 0) at_high /= 2;
        kept = 1;
      } else {
        high = x;
        at_high = here;
        if (kept < 0) at_low /= 2;
        kept = -1;
      }
    }
  }
  return std::copysign(1 / high, place.turn[pair.place]);
}

// The least distance from 0 of the parabola through three values at even distances.
double TimeBound::least_through(double first, double second, double third) {
  if (!(first * second > 0 && second * third > 0)) return 0;
  const double least = std::min({std::abs(first), std::abs(second), std::abs(third)});
  const double rise = third - first;
  const double bend = first - 2 * second + third;
  if (!(std::abs(rise) < 2 * std::abs(bend))) return least;
  return std::min(least, std::abs(second - rise * rise / (8 * bend)));
}

// Each |q'| is least at an end.
double TimeBound::cap_within(const Place& from, const Place& middle, const Place& to) const {
  double cap = fastest;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double least = std::min(std::abs(from.slope[i]), std::abs(to.slope[i]));
    const double velocity = axes_[i].velocity.value();
    if (velocity > 0 && least > 0) cap = std::min(cap, squared(velocity / least));
  }
  const std::size_t pairs = axes_.size() * (axes_.size() - 1) / 2;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const double turning = least_through(from.turning[pair], middle.turning[pair], to.turning[pair]);
    if (turning > 0) cap = std::min(cap, 1 / turning);
  }
  return cap;
}

TimeBound::Joint TimeBound::joint_at(const Place& place) const {
  Joint joint{.place = place,
              .direction = place.slope,
              .steepness = std::sqrt(squares_of(place.slope)),
              .rest_cap = rest_cap(place)};
  for (double& part : joint.direction) part = joint.steepness > 0 ? part / joint.steepness : 0;
  return joint;
}

// The greatest x after the joint at which no axis's velocity jumps by more than rounding.
double TimeBound::kink_cap(const Joint& before, const Joint& after) const {
  double cap = fastest;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double jump = std::abs(after.direction[i] - before.direction[i]) * after.steepness;
    if (jump > 0 && axes_[i].velocity.value() > 0)
      cap = std::min(cap, squared(rounding * axes_[i].velocity.value() / jump));
  }
  return cap;
}

// The largest x with which a path can begin or end at a stop at this position. Each axis jumps to its velocity, and an
// axis with a jerk limit has the acceleration 0 there: as in turning_at(), with those accelerations.
double TimeBound::rest_cap(const Place& place) const {
  if (!any_jumps_) return 0;
  double cap = fastest;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!ramps_[i].limits() || place.slope[i] == 0) continue;
    const double most = axes_[i].start_stop.value() + rounding * axes_[i].velocity.value();
    cap = std::min(cap, squared(most / place.slope[i]));
  }
  const auto strength = [&](std::size_t i) {
    return axes_[i].acceleration.value() * (axes_[i].jerk > MmPerSecond3(0) ? acceleration_rounding : 1);
  };
  std::size_t pair = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j, ++pair) {
      if (!ramps_[i].limits() || !ramps_[j].limits() || place.turn[pair] == 0) continue;
      const double most = strength(i) * std::abs(place.slope[j]) + strength(j) * std::abs(place.slope[i]);
      cap = std::min(cap, most / std::abs(place.turn[pair]));
    }
  }
  return cap;
}

// The largest x at an end of the cell, with x at the other end: no axis speeds up or brakes more than it can.
double TimeBound::most_at(const End& end, const End& other, double at_other, const Cell& cell) const {
  double most = end.cap;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!ramps_[i].limits() || !(end.slope[i] > cell.standing)) continue;
    if (other.slope[i] * at_other >= most * end.slope[i]) continue;  // it need not speed up for that
    most = std::min(most, ramps_[i].square_after(other.slope[i] * at_other, std::abs(cell.way[i])) / end.slope[i]);
  }
  return most;
}

double TimeBound::least_time(const Cell& cell, double entry, double exit) const {
  double time = cell.length / std::sqrt(cell.cap);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double steepest = std::max(cell.entry.slope[i], cell.exit.slope[i]);
    if (!ramps_[i].limits() || !(steepest > cell.standing)) continue;
    double top = steepest * cell.cap;
    if (axes_[i].velocity > MmPerSecond(0)) top = std::min(top, squared(axes_[i].velocity.value()));
    // Nowhere slower than the slower end, it takes no longer than the time so far.
    const double slowest = std::min({cell.entry.slope[i] * entry, cell.exit.slope[i] * exit, top});
    if (squared(cell.way[i]) <= squared(time) * slowest) continue;
    const AxisRamp::Squares squares{.start = cell.entry.slope[i] * entry, .end = cell.exit.slope[i] * exit, .top = top};
    time = std::max(time, ramps_[i].least_time(squares, std::abs(cell.way[i])));
  }
  return time;
}

// `last` is the largest x at the end of the window.
void TimeBound::plan_backwards(double last) {
  for (std::size_t i = cells_.size(); i-- > 0;) {
    Cell& cell = cells_[i];
    cell.controllable = most_at(cell.entry, cell.exit, std::min(last, cell.exit.cap), cell);
    last = cell.controllable / cell.entry_scale;
  }
}

// The largest x at the end of a cell that is entered with this x.
double TimeBound::exit_of(std::size_t cell, double entry, double at_end) const {
  const bool is_last = cell + 1 == cells_.size();
  const double next = is_last ? at_end : cells_[cell + 1].controllable / cells_[cell + 1].entry_scale;
  return std::min(next, most_at(cells_[cell].exit, cells_[cell].entry, entry, cells_[cell]));
}

// Adds the time of the first `cells` cells, which are played.
void TimeBound::settle(std::size_t cells) {
  const bool all = cells == cells_.size();
  if (cells_.empty()) return;
  const double at_end = all ? (joint_ ? joint_->rest_cap : 0) : cells_.back().exit.cap;
  if (!turning_pairs_.empty()) lower_caps(at_end, all);
  plan_backwards(at_end);
  for (std::size_t i = 0; i < cells; ++i) {
    const Cell& cell = cells_[i];
    x_ = std::min(x_ * cell.entry_scale, cell.controllable);
    const double exit = exit_of(i, x_, at_end);
    if (ways_.any()) time_ = ways_.enter(rides_in(cell, x_, exit), time_);
    time_ += least_time(cell, x_, exit);
    x_ = exit;
  }
  cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(cells));
  turns_.erase(turns_.begin(), turns_.begin() + static_cast<std::ptrdiff_t>(cells * turning_pairs_.size()));
}

// `steady`: the path rests without acceleration.
void TimeBound::end_stretch(bool steady) {
  settle(cells_.size());
  time_ = ways_.rest(time_, steady);
  raise_by_line(steady);
  line_ = Line{.began = time_, .steady = steady};
  joint_.reset();
  x_ = 0;
}

JerkTimeBound::Rides TimeBound::rides_in(const Cell& cell, double entry, double exit) const {
  JerkTimeBound::Rides rides;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double steepest = std::max(cell.entry.slope[i], cell.exit.slope[i]);
    if (!(steepest > cell.standing)) continue;
    const double velocity = axes_[i].velocity.value();
    const double top = velocity > 0 ? std::min(steepest * cell.cap, squared(velocity)) : steepest * cell.cap;
    rides[i] = {
        .way = cell.way[i], .entry = cell.entry.slope[i] * entry, .exit = cell.exit.slope[i] * exit, .top = top};
  }
  return rides;
}

// Whether the axes with a limit of jerk go back where they came from. Then their acceleration may go on through the
// rest. In any other corner it would jump.
bool TimeBound::goes_back(const Joint& before, const Joint& after) const {
  double common = 0;
  double size_before = 0;
  double size_after = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!(axes_[i].jerk > MmPerSecond3(0))) continue;
    common += before.direction[i] * after.direction[i];
    size_before += squared(before.direction[i]);
    size_after += squared(after.direction[i]);
  }
  return common < -nearly_back * std::sqrt(size_before * size_after);
}

void TimeBound::add_to_line(const Segment& segment, const Place& place) {
  if (!line_) return;
  Line& line = *line_;
  double apart = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    apart = std::max(apart, std::abs(place.slope[i] - line.direction[i]));
  }
  if (segment.curve.shape() != Curve::Shape::line || (line.curves > 0 && apart > standing)) {
    line_.reset();
    return;
  }
  line.length += segment.curve.length().value();
  line.top = std::max(line.top, std::sqrt(std::min(place.cap, squared(segment.speed.value()))));
  if (line.curves++ > 0) return;
  line.direction = place.slope;
  const auto lower = [](double& lowest, double limit, double part) {
    if (limit > 0 && part > standing && (lowest == 0 || limit / part < lowest)) lowest = limit / part;
  };
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    lower(line.acceleration, axes_[i].acceleration.value(), std::abs(place.slope[i]));
    lower(line.jerk, axes_[i].jerk.value(), std::abs(place.slope[i]));
  }
}

// On a straight line from rest to rest several axes may set limits: one the jerk, another the acceleration.
void TimeBound::raise_by_line(bool steady) {
  if (!line_ || line_->curves == 0) return;
  const RampBound ramp(line_->acceleration, line_->jerk);
  if (!ramp.limits()) return;
  const double jump = std::sqrt(rest_cap({.slope = line_->direction}));
  const double time = ramp.least_time({.speed = jump, .steady = line_->steady}, {.speed = jump, .steady = steady},
                                      line_->length, line_->top);
  time_ = std::max(time_, line_->began + time);
}

}  // namespace passo::proof
