#include "passo/study/ideal_path.hpp"

#include <cmath>

namespace passo {
namespace {

constexpr double full_turn = 6.283185307179586;

// The angle from a to b about the centre, in −π … π, counterclockwise positive.
double angle_between(const Place& a, const Place& b, const Place& centre) {
  const auto ax = static_cast<double>(a[0] - centre[0]);
  const auto ay = static_cast<double>(a[1] - centre[1]);
  const auto bx = static_cast<double>(b[0] - centre[0]);
  const auto by = static_cast<double>(b[1] - centre[1]);
  return std::atan2(ax * by - ay * bx, ax * bx + ay * by);
}

}  // namespace

IdealPath::IdealPath(const StepMove& move) : move_(move), before_(move.from) {
  if (!move.arc) {
    double square = 0;
    for (std::size_t axis = 0; axis < move.axes(); ++axis) {
      const auto d = static_cast<double>(move.to[axis] - move.from[axis]);
      square += d * d;
    }
    length_ = std::sqrt(square);
    return;
  }
  const Place& centre = move.arc->centre;
  radius_ = std::hypot(static_cast<double>(move.from[0] - centre[0]), static_cast<double>(move.from[1] - centre[1]));
  sweep_ = angle_between(move.from, move.to, centre);
  if (move.arc->clockwise) sweep_ = -sweep_;
  if (sweep_ <= 0) sweep_ += full_turn;
  length_ = radius_ * sweep_;
}

std::array<double, most_axes> IdealPath::at(double share) const {
  std::array<double, most_axes> point{};
  if (!move_.arc) {
    for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
      const auto start = static_cast<double>(move_.from[axis]);
      point[axis] = start + share * (static_cast<double>(move_.to[axis]) - start);
    }
    return point;
  }
  const Place& centre = move_.arc->centre;
  const double turned = move_.arc->clockwise ? -share * sweep_ : share * sweep_;
  const double angle = turned + std::atan2(static_cast<double>(move_.from[1] - centre[1]),
                                           static_cast<double>(move_.from[0] - centre[0]));
  point[0] = static_cast<double>(centre[0]) + radius_ * std::cos(angle);
  point[1] = static_cast<double>(centre[1]) + radius_ * std::sin(angle);
  return point;
}

double IdealPath::line_progress(const Place& place) const {
  double along = 0;
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
    along +=
        static_cast<double>(place[axis] - move_.from[axis]) * static_cast<double>(move_.to[axis] - move_.from[axis]);
  }
  return length_ == 0 ? 1 : along / (length_ * length_);
}

double IdealPath::arc_progress(const Place& place) {
  const double turned = angle_between(before_, place, move_.arc->centre);
  travelled_ += move_.arc->clockwise ? -turned : turned;
  before_ = place;
  return travelled_ / sweep_;
}

double IdealPath::progress(const Place& place) {
  return move_.arc ? arc_progress(place) : line_progress(place);
}

double IdealPath::distance(const Place& place) const {
  if (move_.arc) {
    const Place& centre = move_.arc->centre;
    return std::abs(std::hypot(static_cast<double>(place[0] - centre[0]), static_cast<double>(place[1] - centre[1])) -
                    radius_);
  }
  // The distance is summed from the foot on the line, axis by axis: a difference of squares would lose small values.
  const double share = line_progress(place);
  double square = 0;
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
    const auto d = static_cast<double>(move_.to[axis] - move_.from[axis]);
    const double off = static_cast<double>(place[axis] - move_.from[axis]) - share * d;
    square += off * off;
  }
  return std::sqrt(square);
}

}  // namespace passo
