#include "chord_fitter.hpp"

#include <algorithm>
#include <cmath>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// In tolerances: the greatest distance of the chords from a cubic through few of them. Such a cubic may treat features
// of the curve as rounding, so it must leave more of the tube.
constexpr double share_for_few = 0.5;
constexpr std::size_t few = 20;
// The search for a longer fit ends where the error is more than this multiple of the least error. On a coarse grid,
// where the chords are far from the cubic, the errors of longer windows fluctuate.
constexpr double hopeless = 1.05;
constexpr double hopeless_if_rounded = 4;
// After a fit so many chords are tried, even if fewer have none.
constexpr std::size_t patience = 96;
// A turn that would move a vertex by more than this share of the tolerance is a corner if it is also seen from so far
// away, in tolerances, where rounding hardly turns anything. What turns by more than that from there is a corner.
constexpr double sure_share = 0.5;
constexpr double look_around = 16;
constexpr double most_turn = 0.5;
// The cosine of the sharpest turn from chord to chord: a little more than the right angle of the stairs of a grid,
// whose chords a free end may have moved.
constexpr double sharpest = -0.3;
// Of the tolerance: a shorter chord may be a step of rounding in one axis, whichever axes count for the length.
constexpr double short_chord = 2;
// Of the chords of a cubic, so much before its end counts for the next one too, so that both have the same direction.
constexpr double overlap_share = 0.15;
constexpr std::size_t most_behind = 128;

// In tolerances: so far from a corner nothing is fitted. There the motion is slow, and the corner needs all of the
// tube.
constexpr double clearance = 15;
constexpr double far = 1e9;

// A row of this many lines and arcs, each of at most this many tolerances, is a curve in pieces, so the next arc is
// split.
constexpr int row_of_a_curve = 2;
constexpr double short_piece = 128;
// In tolerances: the distance of a part of an arc from its chord; and the distance of two centres that are rounded from
// the same one.
constexpr double part_beside_chord = 0.05;
constexpr double most_parts_of_arc = 64;
constexpr double same_center = 0.25;

// The next window is so many times as long as the last one. The first is so much of that of the fit before.
constexpr double growth = 1.4;
constexpr double first_share = 0.5;

// An error h of a vertex causes a turn of up to h (1/a + 1/b) between chords of the lengths a and b, and twice that if
// the errors of its neighbours are on the other side. Returns h in tolerances.
double turn_seen(double turn, double before, double after, double tolerance) {
  return turn * before * after / (2 * tolerance * (before + after));
}

Point unit(const Point& way) {
  return way * (1 / length_of(way));
}

bool moves_more_than_xyz(const Point& way) {
  double sum = 0;
  for (std::size_t i = 3; i < axis_count; ++i) sum += std::abs(way.values[i]);
  return sum > 0;
}

// How far s goes on along a heading.
double counted_along(const Point& heading, const Point& way, const SurfaceScale& surface) {
  const CountedGroup group = counted_group(heading, surface);
  if (group == CountedGroup::xyz && !surface.counts_any()) {
    double product = 0;
    for (std::size_t i = 0; i < 3; ++i) product += heading.values[i] * way.values[i];
    return std::max(0.0, product / length_in(heading, group));
  }
  const double product = (square_in(heading + way, group, surface) - square_in(heading - way, group, surface)) / 4;
  return std::max(0.0, product / length_in(heading, group, surface));
}

}  // namespace

bool ChordFitter::has(std::uint64_t number) {
  while (number >= ahead_.end() && !at_end_) {
    Ahead& next = ahead_.append();
    at_end_ = !merger_.next(next.item, next.deviation);
    at_end_ ? ahead_.drop_back() : read_in(ahead_.end() - 1);
  }
  return number < ahead_.end();
}

void ChordFitter::read_in(std::uint64_t number) {
  Ahead& next = ahead_[number];
  next.moved = 0;
  next.is_chord = false;
  next.is_inside = false;
  const Segment* const segment = segment_at(number);
  if (segment == nullptr) {
    row_.count = 0;
    return;
  }
  next.end = segment->curve.end();
  next.is_chord = segment->curve.shape() == Curve::Shape::line;
  if (is_in_row(*segment)) split_arc(number);
}

// An arc is split if it is in a row of short lines and arcs with junctions that turn only by rounding: then it is a
// piece of a curve, and its ends and its centre are rounded. Another arc about the same centre is a piece of a circle.
bool ChordFitter::is_in_row(const Segment& segment) {
  const Curve& curve = segment.curve;
  const double length = curve.length().value();
  const double tolerance = segment.tolerance.value();
  const bool is_arc = curve.shape() == Curve::Shape::arc;
  bool goes_on = segment.mode == PathMode::continuous && length <= short_piece * tolerance;
  bool is_new_circle = is_arc;
  if (is_arc && goes_on && row_.count > 0) {
    const double turn = distance(row_.tangent, curve.tangent(Mm(0)));
    goes_on = turn_seen(turn, row_.length, length, tolerance) <= sure_share;
    const Curve::ArcData& arc = curve.arc_data();
    const double apart = std::hypot(arc.first_center - row_.center[0], arc.second_center - row_.center[1]);
    is_new_circle = apart > same_center * tolerance;
  }
  const bool is_piece = goes_on && row_.count >= row_of_a_curve && is_new_circle;
  row_.count = goes_on ? row_.count + 1 : 0;
  row_.length = length;
  if (goes_on) row_.tangent = curve.tangent(curve.length());
  row_.center = {is_arc ? curve.arc_data().first_center : far, is_arc ? curve.arc_data().second_center : far};
  return is_piece;
}

// Each part represents its chord. A fit ends with a part; the rest stays an arc, up to the arc's own end.
void ChordFitter::split_arc(std::uint64_t number) {
  const Segment whole = *segment_at(number);
  const double length = whole.curve.length().value();
  const double beside = part_beside_chord * whole.tolerance.value();
  const double parts =
      std::min(most_parts_of_arc, std::ceil(length * std::sqrt(whole.curve.curvature() / (8 * beside))));
  for (double part = 0; part < parts; ++part) {
    Ahead& ahead = part == 0 ? ahead_[number] : ahead_.append();
    ahead.item = whole;
    if (part > 0) std::get<Segment>(ahead.item).curve = whole.curve.part(Mm(length * part / parts), Mm(length));
    ahead.is_chord = true;
    ahead.is_inside = part + 1 < parts;
    ahead.end = ahead.is_inside ? whole.curve.at(Mm(length * (part + 1) / parts)) : whole.curve.end();
    ahead.deviation = beside;
    ahead.moved = 0;
  }
}

// The continuation of the path after a chord.
PathMode ChordFitter::mode_after(std::uint64_t number) const {
  return ahead_[number].is_inside ? PathMode::continuous : segment_at(number)->mode;
}

bool ChordFitter::may_begin(const Segment& segment) const {
  return ahead_.front().is_chord && segment.mode == PathMode::continuous && segment.lock == SpindleLock::none &&
         mode_before_ != PathMode::exact_path;
}

bool ChordFitter::goes_on_after(std::uint64_t number) {
  const bool is_known = number < known_to_ && ahead_[number].moved == 0;
  if (!is_known && !continues_after(number)) return false;
  known_to_ = std::max(known_to_, number + 1);
  return true;
}

// Whether the next line may be a chord of the same curve.
bool ChordFitter::continues_after(std::uint64_t number) {
  if (!has(number + 1)) return false;
  if (ahead_[number].is_inside) return true;
  if (!ahead_[number + 1].is_chord) return false;
  const Segment* const line = segment_at(number);
  if (!are_alike(*line, *segment_at(number + 1))) return false;
  const Point in = way_of(number);
  const Point out = way_of(number + 1);
  const double before = length_of(in);
  const double after = length_of(out);
  if (dot(in, out) < sharpest * before * after) return false;
  const SurfaceScale& surface = line->surface;
  const bool is_step = std::min(before, after) <= short_chord * tolerance_;
  if (!is_step && counted_group(in, surface) != counted_group(out, surface)) return false;
  const double turn = distance(in * (1 / before), out * (1 / after));
  const double seen = turn_seen(turn, before, after, tolerance_);
  return seen <= sure_share || (seen <= 1 && turns_by_noise(number));
}

// Whether the turn after a line is hardly seen from further away.
bool ChordFitter::turns_by_noise(std::uint64_t number) {
  const double around = look_around * tolerance_;
  const Point in = way_back(number, around);
  const Point out = way_ahead(number + 1, around);
  const double before = length_of(in);
  const double after = length_of(out);
  if (!(before > 0 && after > 0)) return false;
  const double noise = 2 * tolerance_ * (1 / std::max(before, around) + 1 / std::max(after, around));
  return distance(in * (1 / before), out * (1 / after)) <= std::max(most_turn, noise);
}

// The way to the end of a line from about a distance before it, as far as the lines are known.
Point ChordFitter::way_back(std::uint64_t number, double distance) const {
  const Point& end = ahead_[number].end;
  Point way;
  for (std::uint64_t i = number + 1; i-- > ahead_.first();) {
    way = end - segment_at(i)->curve.start();
    if (dot(way, way) >= distance * distance) return way;
  }
  for (std::size_t i = behind_.size(); i-- > 0;) {
    way = end - behind_[i];
    if (dot(way, way) >= distance * distance) return way;
  }
  return way;
}

Point ChordFitter::way_ahead(std::uint64_t number, double distance) {
  const Point start = segment_at(number)->curve.start();
  const std::uint64_t most = number + most_behind;
  Point way;
  for (std::uint64_t i = number; i < most && has(i) && ahead_[i].is_chord; ++i) {
    way = ahead_[i].end - start;
    if (dot(way, way) >= distance * distance || mode_after(i) == PathMode::exact_stop) break;
  }
  return way;
}

// Of stairs along a grid only what goes along the curve counts for s: else s would go on faster than the curve by
// up to 1.41, and by another factor where the curve has another direction. The weights in the sums are those of the
// trapezoidal rule over s: half the chord's length belongs to each of its ends.
void ChordFitter::add_chord(std::uint64_t number) {
  const Ahead& chord = ahead_[number];
  const Point& start = segment_at(ahead_.first())->curve.start();
  const Point way = way_of(number);
  wide_ = wide_ || moves_more_than_xyz(way);
  const double around = look_around * tolerance_;
  heading_ = heading_ * (around / (around + length_of(way))) + way;
  const double length = counted_along(heading_, way, segment_at(number)->surface);
  double s = length;
  if (!vertices_.empty()) {
    sums_.add(vertices_.back(), (last_chord_ + length) / 2, wide_);
    s += vertices_.back().s;
  }
  vertices_.push_back({.s = s, .way = chord.end - start, .deviation = chord.deviation});
  last_chord_ = length;
}

void ChordFitter::add_what_is_behind() {
  const Point& start = segment_at(ahead_.first())->curve.start();
  const SurfaceScale& surface = segment_at(ahead_.first())->surface;
  Vertex after;
  for (std::size_t i = behind_.size(); i-- > 0 && -after.s < overlap_;) {
    const Point way = behind_[i] - start;
    wide_ = wide_ || moves_more_than_xyz(way);
    const double length = counted_along(first_heading_, after.way - way, surface);
    if (after.s < 0) sums_.add(after, length / 2, wide_);
    after = {.s = after.s - length, .way = way};
    sums_.add(after, length / 2, wide_);
  }
}

// The cubic whose curvature is known best. Where rounding is what is left, more chords are better; where the curve is
// no cubic, fewer.
ChordFitter::Fit ChordFitter::best_fit() {
  const std::uint64_t first = ahead_.first();
  if (!(overlap_ > 0)) first_heading_ = way_ahead(first, look_around * tolerance_);
  double start = overlap_ > 0 ? first_share * last_window_ : 0;
  add_chords(1);
  Fit best;
  while (vertices_.size() < most_fitted) {
    const bool begins_long = vertices_.size() == 1 && start > vertices_.back().s;
    const double goal = begins_long ? start : growth * vertices_.back().s;
    bool goes_on = extend_to(std::max<std::size_t>(least_fitted, vertices_.size() + 1), goal);
    const bool is_all = !goes_on;
    if (!goes_on && comes_to_a_corner()) {
      stay_clear_of_the_end();
      goes_on = true;
    }
    if (vertices_.size() < least_fitted || vertices_.back().s <= best.window) break;
    Fit longer = solved(goes_on);
    const bool is_near = passes(longer);
    if (!is_near && begins_long) {  // once more, from few chords on
      start = 0;
      add_chords(1);
      continue;
    }
    if (!is_near && !is_all && best.count == 0 && overlap_ > 0 && vertices_.size() < patience) continue;
    const bool is_rounded = best.deviation > share_for_few * tolerance_;
    if (!is_near || longer.error > (is_rounded ? hopeless_if_rounded : hopeless) * best.error) break;
    const bool leaves_tube = vertices_.size() >= few || longer.deviation <= share_for_few * tolerance_;
    if (leaves_tube && longer.error <= best.error) best = longer;
    if (is_all) break;
  }
  if (best.count == 0 && overlap_ > 0) best = fit_of_fewest();
  if (best.end_is_free) cut(best);
  return best;
}

// In the middle of a curve that bends too much for one cubic through the least number of chords. A chord that is left
// there forms a corner at each end.
ChordFitter::Fit ChordFitter::fit_of_fewest() {
  for (std::uint64_t count = least_fitted - 1; count >= fewest_fitted; --count) {
    add_chords(1);
    if (!extend_to(count, 0)) continue;
    Fit fit = solved(true);
    if (passes(fit) && fit.deviation <= share_for_few * tolerance_) return fit;
  }
  return {};
}

// Adds chords until there are so many, and as long as that. Returns whether the curve continues after them.
bool ChordFitter::extend_to(std::uint64_t count, double length) {
  const std::uint64_t first = ahead_.first();
  bool goes_on = goes_on_after(first + vertices_.size() - 1);
  while (goes_on && vertices_.size() < most_fitted && (vertices_.size() < count || vertices_.back().s < length)) {
    add_chord(first + vertices_.size());
    goes_on = goes_on_after(first + vertices_.size() - 1);
  }
  return goes_on;
}

bool ChordFitter::comes_to_a_corner() {
  const std::uint64_t last = ahead_.first() + vertices_.size() - 1;
  return mode_after(last) != PathMode::exact_stop && has(last + 1) && segment_at(last + 1) != nullptr;
}

void ChordFitter::stay_clear_of_the_end() {
  const double end = vertices_.back().s - clearance * tolerance_;
  std::size_t count = vertices_.size();
  while (count > 0 && vertices_[count - 1].s > end) --count;
  add_chords(count);
}

void ChordFitter::add_chords(std::size_t count) {
  vertices_.clear();
  sums_ = {};
  wide_ = false;
  heading_ = first_heading_;
  add_what_is_behind();
  for (std::size_t i = 0; i < count; ++i) add_chord(ahead_.first() + i);
}

void ChordFitter::remember(std::uint64_t end) {
  const std::uint64_t from = std::max(ahead_.first(), end - std::min<std::uint64_t>(end, most_behind));
  for (std::uint64_t i = from; i < end; ++i) behind_.push_back(segment_at(i)->curve.start());
  if (behind_.size() > 2 * most_behind) behind_.erase(behind_.begin(), behind_.end() - most_behind);
}

// The remainder of a chord after a cubic. A part of an arc becomes a line.
void ChordFitter::move_start(std::uint64_t number, const Point& start) {
  Ahead& ahead = ahead_[number];
  auto& chord = std::get<Segment>(ahead.item);
  chord.mode = mode_after(number);
  ahead.is_inside = false;
  chord.curve = Curve::line(start, ahead.end, chord.surface);
}

void ChordFitter::emit_cubic(const Fit& fit, PathItem& item, double& deviation) {
  const std::uint64_t first = ahead_.first();
  const std::uint64_t next = first + fit.count;
  const Point start = segment_at(first)->curve.start();
  Point end = ahead_[next - 1].end;
  const Point free_end = start + fit.way_at(1);
  const double share = 1 / fit.length;
  const PathMode mode = mode_after(next - 1);
  remember(next + (fit.share > 0 ? 1 : 0));
  std::swap(item, ahead_[first].item);
  auto& segment = std::get<Segment>(item);
  segment.mode = mode;
  first_heading_ = unit(fit.slope_at(1)) * (look_around * tolerance_);
  if (fit.end_is_free) {
    move_start(next, free_end);
    ahead_[next].moved = fit.moved;
    end = free_end;
  }
  segment.curve = Curve::cubic(start, fit.slope_at(0) * share, end, fit.slope_at(1) * share, Mm(fit.length));
  deviation = fit.deviation;
  overlap_ = overlap_share * fit.window;
  last_window_ = fit.window;
  ahead_.drop_before(next);
}

// The pieces that are not fitted. For an arc, all of its remainder.
void ChordFitter::emit_as_is(PathItem& item, double& deviation) {
  std::uint64_t next = ahead_.first() + 1;
  while (ahead_[next - 1].is_inside) ++next;
  const Segment* const segment = segment_at(ahead_.first());
  if (segment != nullptr) remember(next);
  const bool is_arc = segment != nullptr && segment->curve.shape() == Curve::Shape::arc;
  deviation = is_arc ? 0 : ahead_.front().deviation + ahead_.front().moved;
  std::swap(item, ahead_.front().item);
  overlap_ = 0;
  ahead_.drop_before(next);
}

bool ChordFitter::next(PathItem& item, double& deviation) {
  if (!has(ahead_.first())) return false;
  const auto* const ahead = segment_at(ahead_.first());
  bool goes_on = false;
  if (ahead != nullptr && may_begin(*ahead)) {
    const double tolerance_before = tolerance_;
    tolerance_ = ahead->tolerance.value();
    // After a wider tolerance the line stays apart, as in LineMerger.
    const bool stays_apart = mode_before_ == PathMode::continuous && tolerance_before_ > tolerance_;
    if (mode_before_ == PathMode::continuous) tolerance_ = std::min(tolerance_, tolerance_before_);
    if (tolerance_ != tolerance_before) known_to_ = 0;
    goes_on = !stays_apart && goes_on_after(ahead_.first());
  }
  const Fit fit = goes_on && since_corner_ >= clearance * tolerance_ ? best_fit() : Fit{};
  if (fit.count > 0) {
    emit_cubic(fit, item, deviation);
    since_corner_ = far;
  } else {
    emit_as_is(item, deviation);
  }
  const auto* const segment = std::get_if<Segment>(&item);
  mode_before_ = segment != nullptr ? segment->mode : PathMode::exact_stop;
  tolerance_before_ = segment != nullptr ? segment->tolerance.value() : 0;
  if (mode_before_ == PathMode::exact_stop) {
    since_corner_ = far;
    behind_.clear();
    overlap_ = 0;
  } else if (fit.count == 0) {
    since_corner_ = goes_on ? since_corner_ + segment->curve.length().value() : 0;
  }
  return true;
}

}  // namespace passo
