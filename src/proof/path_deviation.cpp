#include "path_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo::proof {
namespace {

// mm: as near as an exact path must be met. Programs round the ends of tangent arcs, and only so can they be passed.
constexpr double exact = 1e-3;
constexpr int pieces_of_a_line = 8;
constexpr double turn_of_a_piece = 0.05;  // radians
constexpr double most_pieces = 100'000;
constexpr int samples_of_a_line = 4;
// How far about the last place the next one is looked for: tolerances, and steps of the walk.
constexpr double tolerances_about = 10;
constexpr double steps_about = 2;
// Farther back than so many tolerances the path does not go: where it does, it has turned without reaching the tip.
constexpr double tolerances_back = 2;
// And how far behind it nothing can be nearer any more.
constexpr double kept_behind = 8;

int pieces_of(const ExactCurve& curve, double share) {
  if (curve.is_line()) return pieces_of_a_line;
  return pieces_of_a_line + static_cast<int>(std::min(curve.turning() * share / turn_of_a_piece, most_pieces));
}

}  // namespace

void PathDeviation::programmed(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment == nullptr) {
    ++programmed_stretch_;
    last_tolerance_ = 0;
    return;
  }
  if (!segment->curve.has_length()) return;
  const ExactCurve curve(segment->curve);
  const double own = segment->tolerance.value();
  const double tolerance = std::max({own, last_tolerance_, exact});
  last_tolerance_ = own;
  chain_.push_back({.curve = curve,
                    .begin = length_,
                    .tolerance = tolerance,
                    .stretch = programmed_stretch_,
                    .line = segment->source.line});
  const int count = curve.is_line() ? samples_of_a_line : pieces_of(curve, 1);
  for (int i = 0; i <= count; ++i) {
    const double s = curve.length() * i / count;
    samples_.push_back({.at = length_ + s,
                        .place = curve.place(s),
                        .tolerance = tolerance,
                        .distance = INFINITY,
                        .stretch = programmed_stretch_,
                        .line = segment->source.line});
  }
  length_ += curve.length();
}

// The nearest place between from and to. Before all others those within the tolerance that do not lead back, where a
// path turns and goes beside itself; of places equally near (a drill goes down and up the same way) the one that is
// nearest to `expected`.
PathDeviation::Match PathDeviation::match(const Point& point, double from, double to, double expected) const {
  constexpr double nearer = 1e-7;  // mm
  Match best{.at = at_, .distance = INFINITY};
  auto segment =
      std::partition_point(chain_.begin(), chain_.end(), [&](const Programmed& one) { return one.end() < from; });
  for (; segment != chain_.end() && segment->begin <= to && segment->stretch <= planned_stretch_; ++segment) {
    if (segment->stretch < planned_stretch_) continue;
    const double low = std::clamp(from - segment->begin, 0.0, segment->curve.length());
    const double high = std::clamp(to - segment->begin, low, segment->curve.length());
    const ExactCurve::Nearest nearest = segment->curve.nearest(point, low, high);
    const double at = segment->begin + nearest.s;
    const bool alike = std::abs(nearest.distance - best.distance) <= nearer;
    const bool onwards =
        nearest.distance <= segment->tolerance && at >= farthest_ - tolerances_back * segment->tolerance;
    const bool better = onwards != best.onwards ? onwards
                        : alike                 ? std::abs(at - expected) < std::abs(best.at - expected)
                                                : nearest.distance < best.distance;
    if (better) best = {.at = at, .distance = nearest.distance, .onwards = onwards, .segment = &*segment};
  }
  return best;
}

// Near the last place, and not behind the farthest one: a path that goes back beside itself would be followed the wrong
// way. Where nothing there is within the tolerance, farther ahead, and behind.
PathDeviation::Match PathDeviation::match_ahead(const Point& point, double step, double expected) const {
  const auto here =
      std::partition_point(chain_.begin(), chain_.end(), [&](const Programmed& one) { return one.end() < at_; });
  const double about = tolerances_about * (here != chain_.end() ? here->tolerance : exact);
  const double behind = about + step;
  const double ahead = about + steps_about * step;
  Match best;
  for (const auto& [from, wider] : {std::pair{farthest_, 1.0}, {farthest_, 8.0}, {at_, 1.0}, {at_, 8.0}, {at_, 64.0}}) {
    const Match found = match(point, from - behind, from + wider * ahead, expected);
    if (best.segment == nullptr || found.distance < best.distance) best = found;
    if (best.segment != nullptr && best.distance <= best.segment->tolerance) break;
  }
  return best;
}

void PathDeviation::planned(const PlannedMove& move, Seconds time) {
  if (!move.segment.curve.has_length() || move.phase_count == 0) return;
  walk(ExactCurve(move.segment.curve), move.from().value(), move.to.value(), time);
}

void PathDeviation::walk(const ExactCurve& curve, double from, double to, Seconds time) {
  const int count = pieces_of(curve, (to - from) / curve.length());
  const double step = (to - from) / count;
  for (int i = 0; i <= count; ++i) {
    const double s = from + step * i;
    const double before = at_;
    const Match found = match_ahead(curve.place(s), step, i > 0 ? at_ + step : at_);
    if (found.segment == nullptr) {  // nothing was programmed that this could be
      raise(INFINITY, exact, 0, time);
      continue;
    }
    raise(found.distance, found.segment->tolerance, found.segment->line, time);
    at_ = found.at;
    farthest_ = std::max(farthest_, at_);
    place_ = curve.place(s);
    if (i > 0) approach(curve, s - step, s, before, step);
  }
  forget(at_ - kept_behind * (step + tolerances_about * (chain_.empty() ? exact : chain_.front().tolerance)), time);
}

// The programmed points about a piece of the walk see how near it comes.
void PathDeviation::approach(const ExactCurve& curve, double from, double to, double before, double step) {
  const double about = steps_about * step + tolerances_about * (chain_.empty() ? exact : chain_.front().tolerance);
  const double first = std::min(before, at_) - about;
  const double last = std::max(before, at_) + about;
  auto sample =
      std::partition_point(samples_.begin(), samples_.end(), [&](const Sample& one) { return one.at < first; });
  for (; sample != samples_.end() && sample->at <= last; ++sample) {
    if (sample->stretch != planned_stretch_ || sample->distance == 0) continue;
    sample->distance = std::min(sample->distance, curve.nearest(sample->place, from, to).distance);
  }
}

void PathDeviation::forget(double before, Seconds time) {
  const auto played = [&](std::uint64_t stretch, double end) {
    return stretch < planned_stretch_ || (stretch == planned_stretch_ && end < before);
  };
  while (!samples_.empty() && played(samples_.front().stretch, samples_.front().at)) {
    const Sample& sample = samples_.front();
    // What was never passed is as far away as the path is now.
    const bool passed = std::isfinite(sample.distance) || !place_;
    raise(passed ? sample.distance : distance(sample.place, *place_), sample.tolerance, sample.line, time);
    samples_.pop_front();
  }
  while (!chain_.empty() && played(chain_.front().stretch, chain_.front().end())) chain_.pop_front();
}

void PathDeviation::rest(Seconds time) {
  ++planned_stretch_;
  forget(at_, time);
  at_ = chain_.empty() ? length_ : chain_.front().begin;
  farthest_ = at_;
}

void PathDeviation::finish(Seconds time) {
  planned_stretch_ = programmed_stretch_;
  rest(time);
}

void PathDeviation::raise(double value, double tolerance, std::uint32_t line, Seconds time) {
  Finding& finding = proof_.deviation;
  const bool more = finding.limit > 0 ? value * finding.limit > finding.value * tolerance : true;
  if (more) finding = {.value = value, .limit = tolerance, .time = time, .line = line};
}

}  // namespace passo::proof
