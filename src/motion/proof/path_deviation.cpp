#include "path_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo::proof {
namespace {

// mm: how near an exact path must be met. Programs round the ends of tangent arcs, which cannot be passed otherwise.
constexpr double exact = 1e-3;
constexpr int least_strides = 8;
constexpr double turn_of_a_piece = 0.05;  // radians
constexpr double most_pieces = 100'000;
// A piece is given up if it needs more than so many tolerances, and more than so many times what the best piece needs.
constexpr double kept = 2;
// But so many pieces beyond those are kept, so that the size of a detour that was left out is measured.
constexpr std::size_t looked_ahead = 8;

int pieces_of(const ExactCurve& curve, double share) {
  if (curve.is_line()) return 1;
  return 1 + static_cast<int>(std::min(curve.turning() * share / turn_of_a_piece, most_pieces));
}

}  // namespace

void PathDeviation::programmed(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment == nullptr) {
    ++programmed_stretch_;
    last_tolerance_ = last_turn_tolerance_ = 0;
    return;
  }
  if (!segment->curve.has_length()) return;
  const double own = segment->tolerance.value();
  const double own_turn = segment->turn_tolerance > 0 ? segment->turn_tolerance : own;
  const double tolerance = std::max({own, last_tolerance_, exact});
  const double turn_tolerance = std::max({own_turn, last_turn_tolerance_, exact});
  const ExactCurve curve(segment->curve);
  const int count = pieces_of(curve, 1);
  Programmed& programmed = chain_.emplace_back(Programmed{.curve = curve,
                                                          .tolerance = tolerance,
                                                          .degree = tolerance / turn_tolerance,
                                                          .line = segment->source.line,
                                                          .speed = segment->speed.value(),
                                                          .pieces = count});
  last_tolerance_ = own;
  last_turn_tolerance_ = own_turn;
  for (int i = 0; i < count; ++i) {
    const double from = curve.length() * i / count;
    pieces_.push_back({.of = &programmed,
                       .from = from,
                       .to = curve.length() * (i + 1) / count,
                       .begin = curve.place(from),
                       .stretch = programmed_stretch_,
                       .now = {}});
  }
}

void PathDeviation::planned(const PlannedMove& move, const ExactCurve& curve, Seconds time) {
  if (move.segment.takes_up_backlash) return;  // the tool stays where it is
  const double from = move.from().value();
  const double way = move.to.value() - from;
  if (reached_ == 0) {
    begin(curve.place(from), time);
    note_speed();
  }
  const int count = least_strides - 1 + pieces_of(curve, way / curve.length());
  double at = from;
  for (int i = 1; i <= count; ++i) {
    const double next = from + way * i / count;
    step({.curve = curve, .from = at, .to = next, .time = time});
    at = next;
  }
  note_speed();
}

void PathDeviation::note_speed() {
  speed_before_ = std::exchange(speed_, 0);
  for (std::size_t i = 0; i < reached_; ++i) speed_ = std::max(speed_, pieces_[i].of->speed);
}

void PathDeviation::went(std::span<const Point> places, Seconds time) {
  if (reached_ == 0) begin(places.front(), time);
  for (const Point& place : places) {
    if (place_ && distance(*place_, place) == 0) continue;
    const ExactCurve line(Curve::line(place_ ? *place_ : places.front(), place));
    if (line.length() > 0) step({.curve = line, .from = 0, .to = line.length(), .time = time});
  }
}

bool PathDeviation::is_in_stretch(std::size_t piece) const {
  return piece < pieces_.size() && pieces_[piece].stretch == planned_stretch_;
}

// Both paths start at their first points.
void PathDeviation::begin(const Point& place, Seconds time) {
  place_ = place;
  if (!is_in_stretch(0)) return;
  Piece& first = pieces_.front();
  first.now = {.multiple = 0, .finding = {}};
  first.now.raise(distance(first.begin, place, first.of->degree), *first.of, time);
  reached_ = 1;
  most_ = kept * std::max(1.0, first.now.multiple);
}

// While the planned path's point makes its stride, the other point stays on its piece or comes to it from the piece
// before. At the stride's end they must be near.
void PathDeviation::step(const Stride& stride) {
  if (reached_ == 0) {  // nothing was programmed that this motion could be
    proof_.deviation = {.value = INFINITY, .limit = exact, .time = stride.time, .line = 0};
    return;
  }
  place_ = stride.curve.place(stride.to);
  Worst before;
  std::size_t ahead = 0;
  for (std::size_t i = 0; is_in_stretch(i) && (i < reached_ || ahead <= looked_ahead); ++i) {
    Piece& piece = pieces_[i];
    if (before.multiple < piece.now.multiple) {
      const Worst there = passed(before, piece, stride);
      if (there.multiple < piece.now.multiple) piece.now = there;
    }
    reached_ = std::max(reached_, i + 1);
    before = piece.now;  // the point may go on before the stride ends
    stay(piece, *place_, stride.time);
    ahead = std::min(before.multiple, piece.now.multiple) > most_ ? ahead + 1 : 0;
  }
  give_up();
}

void PathDeviation::Worst::raise(double away, const Programmed& of, Seconds time) {
  if (away <= multiple * of.tolerance) return;
  multiple = away / of.tolerance;
  finding = {.value = away, .limit = of.tolerance, .time = time, .line = of.line};
}

// Passes the start of a piece when the planned path's point is nearest to it. If even that cannot be near enough to
// count, passes it at the stride's end.
PathDeviation::Worst PathDeviation::passed(const Worst& before, const Piece& piece, const Stride& stride) const {
  Worst past = before;
  const double tolerance = piece.of->tolerance;
  const double degree = piece.of->degree;
  const double at_end = distance(piece.begin, *place_, degree);
  if (at_end <= before.multiple * tolerance) return past;
  const double most = std::min(most_, piece.now.multiple);
  const bool counts = stride.curve.nearest_at_best(piece.begin, stride.from, stride.to, degree) < most * tolerance;
  past.raise(counts ? stride.curve.nearest(piece.begin, stride.from, stride.to, degree).distance : at_end, *piece.of,
             stride.time);
  return past;
}

void PathDeviation::stay(Piece& piece, const Point& place, Seconds time) {
  if (distance(piece.begin, place, piece.of->degree) <= piece.now.multiple * piece.of->tolerance) return;
  piece.now.raise(piece.of->curve.nearest(place, piece.from, piece.to, piece.of->degree).distance, *piece.of, time);
}

void PathDeviation::give_up() {
  double best = INFINITY;
  for (std::size_t i = 0; i < reached_; ++i) best = std::min(best, pieces_[i].now.multiple);
  most_ = kept * std::max(1.0, best);
  for (; pieces_.front().now.multiple > most_; --reached_) drop_front();
  std::size_t last = reached_;
  while (pieces_[last - 1].now.multiple > most_) --last;
  for (; reached_ > last + looked_ahead; --reached_) pieces_[reached_ - 1].now = {};
}

void PathDeviation::drop_front() {
  pieces_.pop_front();
  if (--chain_.front().pieces == 0) chain_.pop_front();
}

// The planned path's point waits at its end while the rest of the programmed path is passed. If the planned path never
// came to this stretch, all of the stretch is passed.
void PathDeviation::end_stretch(Seconds time) {
  if (!is_in_stretch(0)) return;
  Worst best{.multiple = reached_ > 0 ? INFINITY : 0, .finding = {}};
  for (; is_in_stretch(0); drop_front()) {
    const Piece& piece = pieces_.front();
    best.raise(distance_from_last(piece.begin, *piece.of), *piece.of, time);
    if (piece.now.multiple < best.multiple) best = piece.now;
    if (!is_in_stretch(1)) best.raise(distance_from_last(piece.of->curve.place(piece.to), *piece.of), *piece.of, time);
  }
  if (best.multiple > proof_.deviation.multiple()) proof_.deviation = best.finding;
}

double PathDeviation::distance_from_last(const Point& place, const Programmed& of) const {
  return place_ ? distance(place, *place_, of.degree) : INFINITY;
}

void PathDeviation::rest(Seconds time) {
  end_stretch(time);
  ++planned_stretch_;
  reached_ = 0;
}

void PathDeviation::finish(Seconds time) {
  while (planned_stretch_ <= programmed_stretch_) rest(time);
}

}  // namespace passo::proof
