#include "passo/path/path_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tube_spline.hpp"

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// How far chords may leave an arc: this share of the tube.
constexpr double chord_share = 0.01;

Segment& segment_in(PathItem& item) {
  auto* const segment = std::get_if<Segment>(&item);
  return segment != nullptr ? *segment : item.emplace<Segment>();
}

}  // namespace

class PathSmoother::Implementation {
 public:
  Implementation(Source<PathItem>& path, Smoothness smoothness)
      : reader_(path), placer_(reader_, smoothness), spline_(reader_, smoothness) {}

  bool next(PathItem& item);

 private:
  const Piece& piece(std::uint64_t number) const { return reader_.pieces()[number]; }
  void give_exact(const ExactPiece& exact, PathItem& item);
  bool give_span(PathItem& item);
  void cut_span();
  void add_chord(const Piece& path, const Point& end);
  void write_span(const TubeSpline::Span& span, Segment& segment) const;
  void stop_at_the_end(const Knot& knot, Segment& segment) const;

  RunReader reader_;
  KnotPlacer placer_;
  TubeSpline spline_;
  bool in_run_ = false;
  TubeSpline::Span span_;
  // For the last span that was cut: the place where its chords ended, and whether that place is not on the spline.
  Point place_;
  bool broken_ = false;
  std::vector<Segment> chords_;
  std::size_t chord_ = 0;
};

PathSmoother::PathSmoother(Source<PathItem>& path, Smoothness smoothness)
    : implementation_(std::make_unique<Implementation>(path, smoothness)) {}

PathSmoother::~PathSmoother() = default;

bool PathSmoother::next(PathItem& item) {
  return implementation_->next(item);
}

bool PathSmoother::Implementation::next(PathItem& item) {
  for (;;) {
    if (chord_ < chords_.size()) {
      item = chords_[chord_++];
      return true;
    }
    if (spline_.next(span_)) {
      if (give_span(item)) return true;
      continue;
    }
    KnotPlacer::Mark mark{};
    if (in_run_ && placer_.next(mark)) {
      switch (mark) {
        case KnotPlacer::Mark::knot: spline_.add(placer_.knot()); break;
        case KnotPlacer::Mark::end_of_stretch: spline_.close(); break;
        case KnotPlacer::Mark::exact_piece: give_exact(placer_.exact_piece(), item); return true;
      }
      continue;
    }
    in_run_ = false;
    switch (reader_.peek()) {
      case RunReader::Next::end: return false;
      case RunReader::Next::action: item = reader_.take_action(); return true;
      case RunReader::Next::run: placer_.begin(); in_run_ = true;
    }
  }
}

void PathSmoother::Implementation::stop_at_the_end(const Knot& knot, Segment& segment) const {
  const Piece& last = piece(knot.piece);
  if (last.rest_after && knot.along >= last.length) segment.mode = PathMode::exact_stop;
}

void PathSmoother::Implementation::give_exact(const ExactPiece& exact, PathItem& item) {
  const Piece& whole = piece(exact.piece);
  Segment& segment = segment_in(item);
  segment = whole.segment;
  segment.curve = whole.segment.curve.part(Mm(exact.from), Mm(exact.to));
  segment.mode = PathMode::continuous;
  stop_at_the_end({.s = 0, .piece = exact.piece, .along = exact.to}, segment);
  reader_.drop_before(exact.piece);
}

// The segment is like the path in the middle of the span, but not faster than any of the path in the span. Where
// |dp/dt| is above 1 (the smoothed path cuts a corner of s), the speed along t is less, so that the tool keeps to the
// feed. Where t advances faster than s, the speed along t is more.
void PathSmoother::Implementation::write_span(const TubeSpline::Span& span, Segment& segment) const {
  const double middle = (span.from.knot.s + span.to.knot.s) / 2;
  std::uint64_t number = span.from.knot.piece;
  while (number < span.to.knot.piece && piece(number).end() <= middle) ++number;
  const CountedGroup group = counted_group(piece(number).first_tangent);
  segment = piece(number).segment;
  for (std::uint64_t i = span.from.knot.piece; i <= span.to.knot.piece; ++i) {
    if (i > span.from.knot.piece && piece(i).start >= span.to.knot.s) break;
    segment.speed = std::min(segment.speed, piece(i).segment.speed);
    segment.rapid = segment.rapid && piece(i).segment.rapid;
    const Heeds& heeds = piece(i).segment.heeds;
    segment.heeds.feed_override = segment.heeds.feed_override && heeds.feed_override;
    if (piece(i).segment.lock != segment.lock || piece(i).segment.pitch != segment.pitch) {
      segment.lock = SpindleLock::none;
    }
    segment.heeds.feed_hold = segment.heeds.feed_hold && heeds.feed_hold;
  }
  const Mm length(span.to.t - span.from.t);
  segment.curve = Curve::cubic(span.from.place, span.from.tangent, span.to.place, span.to.tangent, length);
  const double steepest = std::max({length_in(span.from.tangent, group), length_in(span.to.tangent, group),
                                    length_in(segment.curve.tangent(length / 2), group)});
  const bool even = span.from.knot.rate == 1 && span.to.knot.rate == 1;
  if (steepest > 1 || !even) segment.speed = segment.speed / steepest;
  segment.mode = span.goes_on ? PathMode::continuous : PathMode::exact_stop;
  stop_at_the_end(span.to.knot, segment);
}

// True: the function wrote an item. False: chords are given instead.
bool PathSmoother::Implementation::give_span(PathItem& item) {
  const bool smooth = span_.in_tube && !broken_;
  if (smooth) {
    write_span(span_, segment_in(item));
  } else {
    cut_span();
  }
  reader_.drop_before(span_.to.knot.piece);
  return smooth;
}

// The last resort for a span that could not be kept in the tube. It becomes chords along the path itself, with a stop
// after each. The chords lead back to the spline as soon as the spline is in the tube again.
void PathSmoother::Implementation::cut_span() {
  chords_.clear();
  chord_ = 0;
  if (!broken_) place_ = span_.from.place;
  double tube = piece(span_.to.knot.piece).tube;
  for (std::uint64_t i = span_.from.knot.piece; i <= span_.to.knot.piece; ++i) {
    const Piece& path = piece(i);
    const double from = std::max(0.0, span_.from.knot.s - path.start);
    const double to = std::min(path.length, span_.to.knot.s - path.start);
    tube = std::min(tube, path.tube);
    if (!(to > from)) continue;
    const double chord = std::sqrt(8 * chord_share * path.tube / std::max(path.segment.curve.curvature(), 1e-9));
    const double chords = std::ceil((to - from) / chord);
    for (double k = 1; k <= chords; ++k) {
      const bool last = k == chords && i == span_.to.knot.piece;
      if (last) break;
      add_chord(path, path.segment.curve.at(Mm(from + (to - from) * (k / chords))));
    }
  }
  broken_ = span_.to.deviation > tube;
  const Piece& last = piece(span_.to.knot.piece);
  add_chord(last, broken_ ? last.segment.curve.at(Mm(span_.to.knot.along)) : span_.to.place);
}

void PathSmoother::Implementation::add_chord(const Piece& path, const Point& end) {
  Segment segment = path.segment;
  segment.curve = Curve::line(place_, end);
  segment.mode = PathMode::exact_stop;
  place_ = end;
  if (segment.curve.has_length()) chords_.push_back(std::move(segment));
}

}  // namespace passo
