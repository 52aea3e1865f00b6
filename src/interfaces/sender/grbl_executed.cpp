#include "passo/sender/grbl_executed.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// Reports have three decimals, and come from whole steps.
constexpr double reported_within = 0.03;  // mm
constexpr int samples = 16;

// Where the line from one point to the other is nearest to a place, as a share of the line.
double share_of_line(const Point& from, const Point& to, const Point& place) {
  const Point way = to - from;
  const double length = length_of(way);
  if (!(length > 0)) return 1;
  double along = 0;
  for (const Axis axis : all_axes) along += way[axis] / length * (place[axis] - from[axis]);
  return std::clamp(along, 0.0, length) / length;
}

double distance_to_line(const Point& from, const Point& to, const Point& place) {
  return distance(from + (to - from) * share_of_line(from, to, place), place);
}

// Chords of a curved piece leave it by this much.
double reach_of(const Curve& curve) {
  if (curve.shape() == Curve::Shape::line) return reported_within;
  const double chord = curve.length().value() / samples;
  return reported_within + curve.curvature() * chord * chord / 8;
}

// The first share of a curve from `from` on at which a place lies on it. Empty: there is none, also if the place lies
// before it, because a machine does not go back on a piece.
std::optional<double> share_reached(const Curve& curve, const Point& place, double from) {
  const double reach = reach_of(curve);
  const double length = curve.length().value();
  const double least = from - (length > 0 ? reach / length : 1);
  const int chords = curve.shape() == Curve::Shape::line ? 1 : samples;
  Point start = curve.start();
  for (int i = 0; i < chords; ++i) {
    const Point end = i + 1 == chords ? curve.end() : curve.at(curve.length() * (static_cast<double>(i + 1) / chords));
    const double share = (i + share_of_line(start, end, place)) / chords;
    if (share >= least && distance_to_line(start, end, place) <= reach) return std::max(share, from);
    start = end;
  }
  return {};
}

}  // namespace

double grbl_distance(const Curve& curve, const Point& place) {
  if (curve.shape() == Curve::Shape::line) return distance_to_line(curve.start(), curve.end(), place);
  double nearest = std::numeric_limits<double>::infinity();
  Point from = curve.start();
  for (int i = 1; i <= samples; ++i) {
    const Point to = curve.at(curve.length() * (static_cast<double>(i) / samples));
    nearest = std::min(nearest, distance_to_line(from, to, place));
    from = to;
  }
  return nearest;
}

void GrblExecuted::add(const Curve& curve, const OperationSource& source, Seconds time, std::uint64_t lines,
                       const Point& work_zero) {
  pieces_.push_back(
      {.curve = curve, .source = source, .time = time, .dwell = dwell_, .lines = lines, .work_zero = work_zero});
  dwell_ = Seconds(0);
}

void GrblExecuted::enter() {
  now_ = pieces_.front().source;
  work_zero_ = pieces_.front().work_zero;
}

void GrblExecuted::pass() {
  enter();
  time_ += pieces_.front().dwell + pieces_.front().time;
  pieces_.pop_front();
  share_ = 0;
  if (passed_) passed_();
}

Seconds GrblExecuted::time(std::optional<Seconds> dwell_left) const {
  if (pieces_.empty()) return time_;
  const Piece& first = pieces_.front();
  const Seconds time = time_ + (has_begun() ? first.dwell + first.time * share_ : Seconds(0));
  if (!dwell_left) return time;
  const Seconds after = pieces_.size() > 1 ? pieces_[1].dwell : dwell_;
  const Seconds dwell = has_begun() ? after : first.dwell;
  return time + std::max(Seconds(0), dwell - *dwell_left);
}

bool GrblExecuted::has_begun() const {
  return share_ * pieces_.front().curve.length().value() > reported_within;
}

void GrblExecuted::hear(std::uint64_t answered, std::size_t blocks, const Point& place) {
  const std::uint64_t certain = answered > blocks ? answered - blocks : 0;
  while (pieces_.size() > 1 && pieces_.front().lines <= certain) pass();
  std::size_t held = 0;
  while (held < pieces_.size() && pieces_[held].lines <= answered) ++held;
  // The piece whose line is being answered may run too, if it has several lines.
  held = std::min(held + 1, pieces_.size());
  for (std::size_t i = 0; i < held; ++i) {
    const auto share = share_reached(pieces_[i].curve, place, i == 0 ? share_ : 0);
    if (!share) continue;
    for (std::size_t passed = 0; passed < i; ++passed) pass();
    enter();
    share_ = *share;
    held -= i;
    break;
  }
  last_line_ = held > 0 ? std::max(now_.line, pieces_[held - 1].source.line) : now_.line;
}

void GrblExecuted::finish() {
  while (!pieces_.empty()) pass();
  time_ += std::exchange(dwell_, Seconds(0));
  last_line_ = now_.line;
}

}  // namespace passo
