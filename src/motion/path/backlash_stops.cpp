#include "backlash_stops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using std::numbers::pi;
// A fraction of a curve's length, and a length in mm: a curve is not divided so near to its ends. Where a spline begins
// along one axis, another axis has a turning point at or near the start, because of rounding; the planner cannot plan a
// piece of 1e-17 mm.
constexpr double least_share_of_curve = 1e-6;
constexpr double least_piece = 1e-6;

// An axis of an arc's plane reverses where the angle from this axis is a multiple of pi.
double next_turn_of_arc(const Curve::ArcData& arc, Axis axis, double length, double from) {
  const double before_axis = axis == arc.first ? 0 : pi / 2;
  const double turn = arc.sweep / length;
  const double half_turns = (arc.start_angle - before_axis + turn * from) / pi;
  constexpr double here = 1e-9;
  const double next = turn > 0 ? std::floor(half_turns + here) + 1 : std::ceil(half_turns - here) - 1;
  const double s = (next * pi + before_axis - arc.start_angle) / turn;
  // Where the radius grows, the axis reverses a little later.
  const double growth = (arc.end_radius - arc.start_radius) / length;
  const double radius = arc.start_radius + growth * s;
  const double later = radius > 0 ? std::atan(growth / (radius * std::abs(turn))) / std::abs(turn) : 0;
  return s + later > from ? s + later : s;
}

// The next position after `from` at which the axis reverses. Infinity if there is none.
double next_turn(const Curve& curve, Axis axis, double from) {
  const double length = curve.length().value();
  const double least = std::min(least_piece, least_share_of_curve * length);
  double next = infinity;
  if (curve.shape() == Curve::Shape::arc) {
    const Curve::ArcData& arc = curve.arc_data();
    if (axis == arc.first || axis == arc.second) next = next_turn_of_arc(arc, axis, length, from + least);
  } else {
    for (const Mm turn : curve.turning_points(axis)) {
      if (turn.value() > from + least) next = std::min(next, turn.value());
    }
  }
  return next < length - least ? next : infinity;
}

}  // namespace

BacklashStops::BacklashStops(Source<PathItem>& path, const BacklashOptions& options)
    : path_(path), options_(options), downs_(options.downs), place_(options.start), farthest_(options.start) {}

bool BacklashStops::next(PathItem& item) {
  if (!std::exchange(started_, true) && emit_start(item)) return true;
  for (;;) {
    if (!turned_.empty() && followed_ <= from_) {
      take_up(from_ > 0 ? place_ : segment_.curve.start(), std::exchange(turned_, AxisSet()), item);
      return true;
    }
    if (before_segment_) {
      item = *std::exchange(before_segment_, std::nullopt);
      return true;
    }
    if (in_segment_) {
      if (emit_piece(item)) return true;
      continue;
    }
    if (!pull(item)) return emit_end(item);
    if (!in_segment_) return true;
  }
}

// Pulls an item. A segment becomes the current one. An action that waits for the spindle's index comes after the
// backlash of the segment behind it is taken up.
bool BacklashStops::pull(PathItem& item) {
  if (ended_ || !path_.next(item)) return false;
  if (const auto* action = std::get_if<Action>(&item)) {
    asks_ = asks_ || action->kind == Action::Kind::probe_end || action->kind == Action::Kind::await_line;
    if (action->kind != Action::Kind::await_index) return true;
    before_segment_ = *action;
    if (!path_.next(item)) {
      item = *std::exchange(before_segment_, std::nullopt);
      return true;
    }
    if (std::holds_alternative<Action>(item)) {  // nothing follows the index
      std::swap(std::get<Action>(item), *before_segment_);
      return true;
    }
  }
  begin(std::get<Segment>(item));
  return true;
}

void BacklashStops::begin(const Segment& segment) {
  if (std::exchange(asks_, false)) {
    if (at_rest_) downs_ = at_rest_().downs;
    farthest_ = segment.curve.start();
  }
  segment_ = segment;
  in_segment_ = true;
  from_ = followed_ = 0;
  static_cast<void>(follow_to_next_turn());
}

// Continues along the segment, up to the point at which an axis reverses. Returns false if none reverses before the
// end.
bool BacklashStops::follow_to_next_turn() {
  const Curve& curve = segment_.curve;
  while (followed_ < curve.length().value()) {
    double end = curve.length().value();
    for (const Axis axis : all_axes) {
      if (has_backlash(axis)) end = std::min(end, next_turn(curve, axis, followed_));
    }
    const Point place = end < curve.length().value() ? curve.at(Mm(end)) : curve.end();
    for (const Axis axis : all_axes) {
      if (!has_backlash(axis)) continue;
      const double back = (place[axis] - farthest_[axis]) * (downs_.has(axis) ? 1 : -1);
      if (back > options_.least[axis]) turned_.add(axis);
    }
    // The return of a tap stays synchronized with the spindle.
    const bool in_step = segment_.lock == SpindleLock::place && !before_segment_;
    if (in_step) turned_ = AxisSet();
    if (!turned_.empty()) return true;
    for (const Axis axis : all_axes) {
      const bool farther = downs_.has(axis) ? place[axis] < farthest_[axis] : place[axis] > farthest_[axis];
      if (farther || !has_backlash(axis)) farthest_[axis] = place[axis];
    }
    followed_ = end;
  }
  return false;
}

// Gives the part up to the point at which an axis reverses, or up to the end. Returns false if the part has no length.
bool BacklashStops::emit_piece(PathItem& item) {
  if (turned_.empty() && !follow_to_next_turn()) {
    in_segment_ = false;
  } else if (followed_ <= from_) {
    return false;
  }
  Segment piece = segment_;
  const bool whole = !in_segment_ && from_ == 0;
  if (!whole) {
    const Mm end = in_segment_ ? Mm(followed_) : segment_.curve.length();
    piece.curve = segment_.curve.part(Mm(from_), end);
    piece.reverse_at = std::max(segment_.reverse_at - Mm(from_), Mm(0));
    if (in_segment_) piece.mode = PathMode::continuous;
  }
  piece.downs = downs_;
  from_ = followed_;
  place_ = piece.curve.end();
  item = piece;
  return true;
}

// The motors of the axes move to the other side of their backlash, while the tool stands still at a position.
void BacklashStops::take_up(const Point& at, AxisSet turned, PathItem& item) {
  Point start = at;
  for (const Axis axis : all_axes) {
    if (!turned.has(axis)) continue;
    const bool down = !downs_.has(axis);
    start[axis] += down ? options_.backlash[axis] : -options_.backlash[axis];
    down ? downs_.add(axis) : downs_.remove(axis);
    farthest_[axis] = at[axis];
  }
  Segment segment = segment_;
  segment.curve = Curve::line(start, at);
  segment.speed = MmPerSecond(infinity);
  segment.rapid = true;
  segment.mode = PathMode::exact_stop;
  segment.tolerance = segment.merge = Mm(0);
  segment.heeds.feed_override = segment.heeds.adaptive_feed = false;
  segment.lock = SpindleLock::none;
  segment.pitch = segment.reverse_at = Mm(0);
  segment.downs = downs_;
  segment.takes_up_backlash = true;
  segment.outputs.power = 0;
  item = segment;
}

bool BacklashStops::emit_start(PathItem& item) {
  if (!options_.counts_items) return false;
  if (downs_.empty()) {
    item = Action{.place = options_.start};
  } else {
    take_up(options_.start, AxisSet(downs_), item);
  }
  return true;
}

bool BacklashStops::emit_end(PathItem& item) {
  ended_ = true;
  if (std::exchange(asks_, false) && at_rest_) {
    downs_ = at_rest_().downs;
    place_ = at_rest_().place;
  }
  if (downs_.empty()) return false;
  take_up(place_, AxisSet(downs_), item);
  return true;
}

}  // namespace passo
