#include "passo/path/path_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pace.hpp"
#include "tube_spline.hpp"
#include "turn_scale.hpp"

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// How far chords may leave an arc: this share of the tube.
constexpr double chord_share = 0.01;

// Where the smoothed path is shorter than s by less, the speed along s stays the feed. An even feed costs fewer phases.
constexpr double worth_raising = 0.95;

// Of a span: a shorter part is not worth a segment of its own.
constexpr double least_part = 1e-3;

Segment& segment_in(PathItem& item) {
  auto* const segment = std::get_if<Segment>(&item);
  return segment != nullptr ? *segment : item.emplace<Segment>();
}

}  // namespace

class PathSmoother::Implementation {
 public:
  Implementation(Source<PathItem>& path, Smoothness smoothness, double share)
      : scale_(path, share), reader_(scale_), placer_(reader_, smoothness), spline_(reader_, smoothness) {}

  bool next(PathItem& item) {
    if (!next_scaled(item)) return false;
    if (auto* const segment = std::get_if<Segment>(&item)) convert_to_degrees(*segment);
    return true;
  }

 private:
  bool next_scaled(PathItem& item);
  const Piece& piece(std::uint64_t number) const { return reader_.pieces()[number]; }
  void give_exact(const ExactPiece& exact, PathItem& item);
  bool give_span(PathItem& item);
  void cut_span();
  void add_chord(const Piece& path, const Point& end);
  // Of a span, in which the pieces from first to last are played alike.
  struct Part {
    double from = 0;  // t in the span
    double to = 0;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
  };
  Part next_part() const;
  void give_part(PathItem& item);
  void write_part(const Part& part, Segment& segment) const;
  void stop_at_the_end(const Knot& knot, Segment& segment) const;

  TurnScale scale_;
  RunReader reader_;
  KnotPlacer placer_;
  TubeSpline spline_;
  bool in_run_ = false;
  TubeSpline::Span span_;
  Part part_;             // the last one given
  bool in_span_ = false;  // more parts follow
  // Of a span that was cut: where it ended, and whether that was not on the spline.
  Point place_;
  bool broken_ = false;
  std::vector<Segment> chords_;
  std::size_t chord_ = 0;
};

PathSmoother::PathSmoother(Source<PathItem>& path, Smoothness smoothness, double share)
    : implementation_(std::make_unique<Implementation>(path, smoothness, share)) {}

PathSmoother::~PathSmoother() = default;

bool PathSmoother::next(PathItem& item) {
  return implementation_->next(item);
}

bool PathSmoother::Implementation::next_scaled(PathItem& item) {
  for (;;) {
    if (in_span_) {
      give_part(item);
      return true;
    }
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

// As the path in its middle. The tool keeps to the feed: where |dp/dt| is above 1, the speed along t is less. The speed
// along t is more where t goes on faster than s, or where the smoothed path is much shorter than s (it cuts a corner).
void PathSmoother::Implementation::write_part(const Part& part, Segment& segment) const {
  const double width = span_.to.t - span_.from.t;
  const bool begins = part.from == 0;
  const bool ends = part.to == width;
  const double middle =
      ((begins ? span_.from.knot.s : piece(part.first).start) + (ends ? span_.to.knot.s : piece(part.last).end())) / 2;
  std::uint64_t number = part.first;
  while (number < part.last && piece(number).end() <= middle) ++number;
  const SurfaceScale& surface = piece(number).segment.surface;
  const CountedGroup group = counted_group(piece(number).first_tangent, surface);
  segment = piece(number).segment;
  segment.curve = Curve::cubic(span_.from.place, span_.from.tangent, span_.to.place, span_.to.tangent, Mm(width));
  const Point in = begins ? span_.from.tangent : segment.curve.tangent(Mm(part.from));
  const Point out = ends ? span_.to.tangent : segment.curve.tangent(Mm(part.to));
  const Point between = segment.curve.tangent(Mm((part.from + part.to) / 2));
  if (!(begins && ends)) segment.curve = segment.curve.part(Mm(part.from), Mm(part.to));
  // The tangent is a quadratic. It stays in the hull of these five, which are the controls of its two halves.
  const Point control = between * 2 - (in + out) * 0.5;
  double steepest = 0;
  for (const Point& tangent : {in, (in + control) * 0.5, between, (control + out) * 0.5, out}) {
    steepest = std::max(steepest, length_in(tangent, group, surface));
  }
  const bool even = span_.from.knot.rate == 1 && span_.to.knot.rate == 1;
  const bool is_short = steepest < worth_raising && segment.lock == SpindleLock::none;
  if (steepest > 1 || is_short || !even) segment.speed = segment.speed / steepest;
  segment.mode = span_.goes_on || !ends ? PathMode::continuous : PathMode::exact_stop;
  if (ends) stop_at_the_end(span_.to.knot, segment);
}

// A span is cut where the feed changes, or what the motion heeds: a slow piece would slow the whole span.
PathSmoother::Implementation::Part PathSmoother::Implementation::next_part() const {
  const double width = span_.to.t - span_.from.t;
  Part part{.from = part_.to, .to = width, .first = part_.last, .last = part_.last};
  for (; part.last < span_.to.knot.piece; ++part.last) {
    if (are_played_alike(piece(part.last).segment, piece(part.last + 1).segment)) continue;
    const Pace pace = Pace::between(span_.from.knot.rate, span_.to.knot.rate, span_.to.knot.s - span_.from.knot.s);
    const double end = pace.reaches(std::max(0.0, piece(part.last).end() - span_.from.knot.s));
    if (end > (1 - least_part) * width) break;
    if (end > part.from + least_part * width) {
      part.to = end;
      break;
    }
    part.first = part.last + 1;
  }
  return part;
}

// True: the function wrote an item. False: chords are given instead.
bool PathSmoother::Implementation::give_span(PathItem& item) {
  const bool smooth = span_.in_tube && !broken_;
  if (smooth) {
    part_ = {.from = 0, .to = 0, .first = span_.from.knot.piece, .last = span_.from.knot.piece};
    give_part(item);
  } else {
    cut_span();
    reader_.drop_before(span_.to.knot.piece);
  }
  return smooth;
}

void PathSmoother::Implementation::give_part(PathItem& item) {
  part_ = next_part();
  write_part(part_, segment_in(item));
  in_span_ = part_.to < span_.to.t - span_.from.t;
  if (!in_span_) reader_.drop_before(span_.to.knot.piece);
}

// The last resort, where a span could not be kept in the tube: chords along the path itself, with a stop after each.
// They lead back to the spline as soon as it is in the tube again.
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
  segment.curve = Curve::line(place_, end, segment.surface);
  segment.mode = PathMode::exact_stop;
  place_ = end;
  if (segment.curve.has_length()) chords_.push_back(std::move(segment));
}

}  // namespace passo
