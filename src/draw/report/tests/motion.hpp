// Moves for tests: a curve travelled from stop to stop with a trapezoidal speed profile.
#pragma once

#include <algorithm>
#include <cmath>

#include "passo/trajectory/phase.hpp"

namespace passo {

inline Point at(double x, double y, double z = 0) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = z;
  return point;
}

inline PlannedMove play(const Curve& curve, double speed, double acceleration, bool rapid = false) {
  PlannedMove move;
  move.segment.curve = curve;
  move.to = move.segment.curve.length();
  move.segment.speed = MmPerSecond(speed);
  move.segment.rapid = rapid;
  const double length = curve.length().value();
  const double top = std::min(speed, std::sqrt(length * acceleration));
  const double ramp = top * top / (2 * acceleration);
  const double cruise = top < speed ? 0 : length - 2 * ramp;
  move.add({Seconds(top / acceleration), Mm(0), MmPerSecond(0), MmPerSecond2(acceleration), MmPerSecond3(0)});
  if (cruise > 0) move.add({Seconds(cruise / top), Mm(ramp), MmPerSecond(top), MmPerSecond2(0), MmPerSecond3(0)});
  move.add(
      {Seconds(top / acceleration), Mm(ramp + cruise), MmPerSecond(top), MmPerSecond2(-acceleration), MmPerSecond3(0)});
  return move;
}

// Returns a move along a line at constant speed, as in the middle of a long path.
inline PlannedMove cruise(const Point& from, const Point& to, double speed, bool rapid = false) {
  PlannedMove move;
  move.segment.curve = Curve::line(from, to);
  move.to = move.segment.curve.length();
  move.segment.speed = MmPerSecond(speed);
  move.segment.rapid = rapid;
  move.add({Seconds(move.segment.curve.length().value() / speed), Mm(0), MmPerSecond(speed), MmPerSecond2(0),
            MmPerSecond3(0)});
  return move;
}

inline PlannedMove feed(const Point& from, const Point& to, double speed = 10, double acceleration = 100) {
  return play(Curve::line(from, to), speed, acceleration);
}
inline PlannedMove rapid(const Point& from, const Point& to, double speed = 50, double acceleration = 100) {
  return play(Curve::line(from, to), speed, acceleration, true);
}

inline Action dwell(double seconds) {
  Action action;
  action.kind = Action::Kind::dwell;
  action.dwell = Seconds(seconds);
  return action;
}

}  // namespace passo
