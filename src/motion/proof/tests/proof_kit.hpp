// Shared by the tests of MotionProver: motion defined by hand, and its proof.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "kit/stage_test.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr double tick_rate = 1e6;

inline ProofOptions options(double jerk = 0) {
  ProofOptions result;
  for (const Axis axis : {Axis::x, Axis::y}) {
    result.axes.push_back({.axis = axis,
                           .step = Mm(0.0025),
                           .velocity = MmPerSecond(100),
                           .acceleration = MmPerSecond2(500),
                           .jerk = MmPerSecond3(jerk)});
  }
  result.tick_rate = Hertz(tick_rate);
  return result;
}

inline Segment segment_of(const Curve& curve, std::uint32_t line = 1, double speed = 1000) {
  return {
      .curve = curve, .speed = MmPerSecond(speed), .tolerance = Mm(0.01), .source = {.line = line, .line_number = -1}};
}
inline Segment line(const Point& from, const Point& to, std::uint32_t number = 1, double speed = 1000) {
  return segment_of(Curve::line(from, to), number, speed);
}
inline Segment circle(double radius, double turns, double speed = 1000) {
  return segment_of(
      Curve::arc(xyz(radius, 0), xyz(radius * std::cos(turns * 2 * pi), radius * std::sin(turns * 2 * pi)), Axis::x,
                 Axis::y, 0, 0, turns * 2 * pi),
      1, speed);
}

inline Phase phase(double duration, double start, double velocity, double acceleration, double jerk = 0) {
  return {.duration = Seconds(duration),
          .start = Mm(start),
          .velocity = MmPerSecond(velocity),
          .acceleration = MmPerSecond2(acceleration),
          .jerk = MmPerSecond3(jerk)};
}

inline PlannedMove move(const Segment& segment, std::initializer_list<Phase> phases) {
  PlannedMove planned{.segment = segment, .phases = {}};
  for (const Phase& one : phases) planned.add(one);
  planned.to = segment.curve.length();
  return planned;
}
// Returns the fastest motion between two stops, without a speed limit.
inline PlannedMove triangle(const Segment& segment, double acceleration) {
  const double length = segment.curve.length().value();
  const double half = std::sqrt(length / acceleration);
  return move(segment, {phase(half, 0, 0, acceleration), phase(half, length / 2, acceleration * half, -acceleration)});
}
inline PlannedMove steady(const Segment& segment, double velocity) {
  return move(segment, {phase(segment.curve.length().value() / velocity, 0, velocity, 0)});
}

inline MotionProof proof_of(const std::vector<Segment>& programmed, const std::vector<PlannedMove>& planned,
                            double jerk = 0) {
  MotionProver prover(options(jerk));
  for (const Segment& segment : programmed) prover.watch(PathItem(segment));
  for (const PlannedMove& one : planned) prover.watch(MotionItem(one));
  return prover.finish();
}
inline MotionProof proof_of(const std::vector<PlannedMove>& planned) {
  std::vector<Segment> programmed;
  for (const PlannedMove& one : planned) programmed.push_back(one.segment);
  return proof_of(programmed, planned);
}
inline double bound_of(const std::vector<Segment>& path) {
  std::vector<PlannedMove> planned;
  for (const Segment& segment : path) planned.push_back(steady(segment, 1));
  return proof_of(planned).time_bound.value();
}

}  // namespace passo::test
