#include "line_merger.hpp"

#include <algorithm>
#include <cmath>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// Vertices closer than this (mm) to a line are on the line except for rounding.
constexpr double rounding = 1e-9;

// A merged line may be shorter than its pieces by this share, so that its time is not less than theirs.
constexpr double least_share_of_length = 0.99;

// Of the tolerance: how far an arc may be from its chord to be replaced by it; and an arc of which all is so close to
// its ends that half of the tube around the chord is left.
constexpr double nearly_straight = 0.2;
constexpr double tiny = 0.5;
// Less of the arc's length than this is no chord of it.
constexpr double least_share_of_arc = 0.9;

// How far an arc is from its chord, if both are passed evenly. An upper bound.
double distance_from_chord(const Curve::ArcData& arc) {
  const double radius = std::max(arc.start_radius, arc.end_radius);
  const double sweep = std::abs(arc.sweep);
  const double change = std::abs(arc.start_radius - arc.end_radius);
  return std::min(2 * radius, radius * sweep * sweep * (1.0 / 8 + sweep / 100) + change * sweep);
}

bool is_line(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  return segment != nullptr && segment->curve.shape() == Curve::Shape::line;
}

}  // namespace

bool are_played_alike(const Segment& before, const Segment& after) {
  return before.speed == after.speed && before.rapid == after.rapid && before.heeds == after.heeds &&
         before.lock == after.lock && before.pitch == after.pitch && before.outputs == after.outputs;
}

bool are_alike(const Segment& before, const Segment& after) {
  return are_played_alike(before, after) && before.tolerance == after.tolerance && before.merge == after.merge &&
         before.turn_tolerance == after.turn_tolerance && before.surface == after.surface &&
         before.mode != PathMode::exact_stop && before.work_zero == after.work_zero;
}

void LineMerger::Cone::begin(const Point& direction, double length, double within) {
  tolerance = within;
  center = direction;
  radius = within / length;
}

bool LineMerger::Cone::has(const Point& direction) const {
  return distance(direction, center) <= radius;
}

// The new ball is the largest one in the intersection of two balls. If one ball lies in the other, it is the inner
// ball. Otherwise it lies between their borders.
void LineMerger::Cone::narrow(const Point& direction, double length) {
  const double allowed = tolerance / length;
  const double apart = distance(direction, center);
  if (apart <= allowed - radius) return;
  if (apart <= radius - allowed) {
    center = direction;
    radius = allowed;
    return;
  }
  center = center + (direction - center) * ((apart + radius - allowed) / (2 * apart));
  radius = (radius + allowed - apart) / 2;
}

bool LineMerger::pull() {
  if (!has_ahead_ && !at_end_) {
    has_ahead_ = path_.next(ahead_);
    at_end_ = !has_ahead_;
    ahead_off_ = 0;
    auto* const segment = has_ahead_ ? std::get_if<Segment>(&ahead_) : nullptr;
    if (segment != nullptr && segment->curve.shape() == Curve::Shape::arc) straighten(*segment);
    mode_read_ = segment != nullptr ? segment->mode : PathMode::exact_stop;
    tolerance_read_ = segment != nullptr ? segment->tolerance.value() : 0;
  }
  return has_ahead_;
}

void LineMerger::straighten(Segment& segment) {
  if (segment.lock != SpindleLock::none) return;
  if (segment.mode == PathMode::exact_path || mode_read_ == PathMode::exact_path) return;
  double tolerance = segment.tolerance.value();
  if (mode_read_ == PathMode::continuous) tolerance = std::min(tolerance, tolerance_read_);
  const Curve::ArcData& arc = segment.curve.arc_data();
  const double off = distance_from_chord(arc);
  const bool is_tiny = 2 * std::max(arc.start_radius, arc.end_radius) <= tiny * tolerance;
  if (!is_tiny && off > nearly_straight * tolerance) return;
  const Curve chord = Curve::line(segment.curve.start(), segment.curve.end(), segment.surface);
  if (chord.length() < segment.curve.length() * least_share_of_arc) return;
  segment.curve = chord;
  ahead_off_ = off;
}

LineMerger::Chord::Chord(const Point& way) : travel(way), length(length_of(way)), direction(way * (1 / length)) {}

bool LineMerger::absorbs(const Segment& merged, const Segment& line, const Chord& chord) const {
  if (!are_alike(merged, line)) return false;
  const Point own = line.curve.end() - line.curve.start();
  const Point before = end_ - merged.curve.start();
  if (!(dot(own, before) > 0)) return false;
  if (!cone_.has(chord.direction)) return false;
  const SurfaceScale& surface = merged.surface;
  const CountedGroup group = counted_group(own, surface);
  if (group != counted_group(before, surface) || group != counted_group(chord.travel, surface)) return false;
  return !(length_in(chord.travel, group, surface) <
           least_share_of_length * (programmed_ + line.curve.length().value()));
}

// The corner before this line is rounded within a wider tolerance than the line's own, and may use all of it on this
// line. So the line stays apart from the next ones, which allow less.
bool LineMerger::stays_apart(const Segment& line) const {
  return mode_before_ == PathMode::continuous && tolerance_before_ > line.tolerance.value();
}

// At most half of what the junction before the line allows. The rest is left for rounding that junction.
double LineMerger::merge_tolerance(const Segment& merged) const {
  double tolerance = merged.merge.value();
  if (mode_before_ == PathMode::exact_path) tolerance = 0;
  if (mode_before_ == PathMode::continuous) tolerance = std::min(tolerance, tolerance_before_ / 2);
  return std::max(tolerance, rounding);
}

void LineMerger::begin(const Segment& merged) {
  end_ = merged.curve.end();
  taken_ = 1;
  programmed_ = merged.curve.length().value();
}

// True: the line ahead became part of the line that is being merged.
bool LineMerger::extend(Segment& merged, double& deviation) {
  const Segment& line = std::get<Segment>(ahead_);
  const Point& start = merged.curve.start();
  if (taken_ == 1) {
    const Chord first(end_ - start);
    cone_.begin(first.direction, first.length, merge_tolerance(merged));
    exact_.begin(first.direction, first.length, rounding);
  }
  const Chord chord(line.curve.end() - start);
  if (!absorbs(merged, line, chord)) return false;
  if (!exact_.has(chord.direction)) deviation = cone_.tolerance;
  if (deviation == 0) exact_.narrow(chord.direction, chord.length);
  cone_.narrow(chord.direction, chord.length);
  programmed_ += line.curve.length().value();
  off_ = std::max(off_, ahead_off_);
  merged.mode = line.mode;
  end_ = line.curve.end();
  ++taken_;
  has_ahead_ = false;
  return true;
}

bool LineMerger::next(PathItem& item, double& deviation) {
  deviation = 0;
  if (!pull()) return false;
  has_ahead_ = false;
  if (!is_line(ahead_)) {
    std::swap(item, ahead_);
    const auto* const segment = std::get_if<Segment>(&item);
    mode_before_ = segment != nullptr ? segment->mode : PathMode::exact_stop;
    tolerance_before_ = segment != nullptr ? segment->tolerance.value() : 0;
    return true;
  }
  item = ahead_;
  off_ = ahead_off_;
  auto& merged = std::get<Segment>(item);
  begin(merged);
  const bool alone = stays_apart(merged);
  while (!alone && taken_ < most_merged && pull() && is_line(ahead_) && extend(merged, deviation)) {
  }
  if (taken_ > 1) merged.curve = Curve::line(merged.curve.start(), end_, merged.surface);
  deviation += off_;
  mode_before_ = merged.mode;
  tolerance_before_ = merged.tolerance.value();
  return true;
}

}  // namespace passo
