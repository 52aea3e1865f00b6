#include "passo/sender/grbl_executed.hpp"

#include <algorithm>
#include <limits>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// Reports have three decimals, and come from whole steps.
constexpr double reported_within = 0.03;  // mm
constexpr int samples = 16;

double distance_to_line(const Point& from, const Point& to, const Point& place) {
  const Point way = to - from;
  const double length = length_of(way);
  if (!(length > 0)) return distance(from, place);
  double along = 0;
  for (const Axis axis : all_axes) along += way[axis] / length * (place[axis] - from[axis]);
  return distance(from + way * (std::clamp(along, 0.0, length) / length), place);
}

// Chords of a curved piece leave it by this much.
double reach_of(const Curve& curve) {
  if (curve.shape() == Curve::Shape::line) return reported_within;
  const double chord = curve.length().value() / samples;
  return reported_within + curve.curvature() * chord * chord / 8;
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

void GrblExecuted::add(const Curve& curve, const OperationSource& source, Seconds time, std::uint64_t lines) {
  pieces_.push_back({.curve = curve, .source = source, .time = time, .lines = lines});
}

void GrblExecuted::pass() {
  now_ = pieces_.front().source;
  time_ += pieces_.front().time;
  pieces_.pop_front();
}

void GrblExecuted::hear(std::uint64_t answered, std::size_t blocks, const Point& place) {
  const std::uint64_t certain = answered > blocks ? answered - blocks : 0;
  while (pieces_.size() > 1 && pieces_.front().lines <= certain) pass();
  std::size_t held = 0;
  while (held < pieces_.size() && pieces_[held].lines <= answered) ++held;
  // The piece whose line is being answered may run too, if it has several lines.
  held = std::min(held + 1, pieces_.size());
  for (std::size_t i = 0; i < held; ++i) {
    if (grbl_distance(pieces_[i].curve, place) > reach_of(pieces_[i].curve)) continue;
    for (std::size_t passed = 0; passed < i; ++passed) pass();
    now_ = pieces_.front().source;
    held -= i;
    break;
  }
  last_line_ = held > 0 ? std::max(now_.line, pieces_[held - 1].source.line) : now_.line;
}

void GrblExecuted::finish() {
  while (!pieces_.empty()) pass();
  last_line_ = now_.line;
}

}  // namespace passo
