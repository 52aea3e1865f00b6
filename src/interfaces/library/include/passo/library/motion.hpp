// Plans a whole path, within limits, to motion in time, or to the steps of motors.
//
//   passo::Path path({.x = 0, .y = 0});
//   path.line_to({.x = 40}, 50);
//   path.line_to({.x = 40, .y = 30}, 50);
//   const passo::Outcome<passo::Motion> motion = passo::plan(path, limits);
//   const passo::MotionState state = motion->at(0.5);
//
// The motion is as fast as the limits of the axes allow. Corners are rounded within the tolerance of the path, so that
// the tool does not stop there. It starts and ends at rest.
//
// Threads: a Path is like a std::vector. A Motion never changes, and may be used by several threads at once. A
// StepTrain belongs to one thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include "passo/library/axes.hpp"
#include "passo/library/finding.hpp"

namespace passo::v1 {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

// Lines, arcs and stops. Functions never fail: plan() reports values out of range, with the number of the piece.
//
// Coordinates: -100,000 to 100,000 mm, -10,000,000 to 10,000,000 degrees. At most 1,000,000 pieces.
class PASSO_EXPORTED Path {
 public:
  explicit Path(const Position& start = {});
  Path(const Path& other);
  Path(Path&& other) noexcept;
  Path& operator=(Path other) noexcept;
  ~Path();

  // How far the rounded path may be from the given one, for the corners after the following pieces: 0 to 100 mm. At the
  // start 0.01 mm. 0: the tool stops at each corner.
  void set_tolerance(double tolerance_mm);
  // `speed_mm_per_s`: the highest speed along the path, above 0. If only A, B and C move: degrees per second.
  void line_to(const Position& end, double speed_mm_per_s = unlimited);
  // An arc about a centre, given in the first and second axis of the plane. `turns`: 1 is up to one full circle
  // counterclockwise, 2 one circle more; -1 is clockwise. From -1000 to 1000, not 0. All other axes move in proportion
  // (helix). The distances of start and end from the centre may differ; the radius then changes in proportion.
  void arc_to(const Position& end, ArcPlane plane, double first_centre_mm, double second_centre_mm, int turns = 1,
              double speed_mm_per_s = unlimited);
  // Stops at the end of the path so far, for so many seconds: 0 to 86,400.
  void stop(double dwell_s = 0);

  // The number of lines, arcs and stops.
  std::size_t size() const;
  Position end() const;

  struct Content;
  const Content& content() const { return *content_; }  // for the library

 private:
  std::unique_ptr<Content> content_;
};

// The limits of an axis: 0.001 to 100,000 mm/s, 0.001 to 1e6 mm/s², 0.001 to 1e9 mm/s³.
struct AxisLimits {
  double velocity_mm_per_s = 0;  // 0: the machine does not have this axis
  double acceleration_mm_per_s2 = 0;
  double jerk_mm_per_s3 = 0;  // 0: no limit. Planning takes several times as long with it
};
struct Limits {
  std::array<AxisLimits, axis_count> axes{};
  AxisLimits& operator[](Axis axis) { return axes[static_cast<std::size_t>(axis)]; }
  const AxisLimits& operator[](Axis axis) const { return axes[static_cast<std::size_t>(axis)]; }
};

// The motion at a moment.
struct MotionState {
  Position position = {};      // mm, degrees
  Position velocity = {};      // per second
  Position acceleration = {};  // per second²
  double speed_mm_per_s = 0;   // along the path; of a move of A, B and C only: degrees per second
  std::uint32_t piece = 0;     // the number of the piece of the Path, from 1; of a program: the line
};

// The motors of a machine, and the clock of their steps.
struct StepOptions {
  // Steps per millimetre or degree, 0.001 to 1e6; negative: the motor turns the other way round. 0: no motor. At most 8
  // motors.
  std::array<double, axis_count> steps_per_mm{};
  double ticks_per_s = 16e6;  // 10,000 to 1e9
  // All steps happen at events, at most so many per second: ticks_per_s / 32,767 to ticks_per_s / 16. At its velocity
  // no axis may make more steps.
  double events_per_s = 1e5;
  double& operator[](Axis axis) { return steps_per_mm[static_cast<std::size_t>(axis)]; }
};

// One step of a motor.
struct Step {
  std::int64_t tick = 0;  // since the start of the motion
  Axis axis = Axis::x;
  bool forward = true;  // the motor's count goes up
};

// All steps of a motion, in order of time. They are computed while they are read, in constant memory.
//
// The steps of the fastest motor are at the tick next to their exact times. Those of the other motors wait for the next
// event: while motors move there are events_per_s / 8 or more of them per second.
class PASSO_EXPORTED StepTrain {
 public:
  StepTrain(StepTrain&& other) noexcept;
  StepTrain& operator=(StepTrain&& other) noexcept;
  ~StepTrain();

  // Writes the next steps, at most `most`, and returns their number. 0: the end.
  std::size_t read(Step* steps, std::size_t most);
  double ticks_per_s() const;

  struct Content;
  explicit StepTrain(std::unique_ptr<Content> content);  // for the library

 private:
  std::unique_ptr<Content> content_;
};

// A planned motion. It takes about 600 bytes for each piece of the rounded path. Copies share it.
class PASSO_EXPORTED Motion {
 public:
  double duration_s() const;
  double length_mm() const;  // of the rounded path, to a few parts in a thousand; without moves of A, B and C only
  // Returns the state at a time: before the start that of the start, after the end that of the end.
  MotionState at(double time_s) const;
  // Writes the states at `count` times: from, from + interval, and so on. Faster than at(). `interval_s` is at least 0.
  void sample(double from_s, double interval_s, std::size_t count, MotionState* states) const;
  // Errors: "steps.*".
  Outcome<StepTrain> steps(const StepOptions& options) const;
  // With the motors of the machine for which a program was planned, and the corrections of their screws. An error for
  // the motion of a Path.
  Outcome<StepTrain> steps() const;

  struct Content;
  explicit Motion(std::shared_ptr<const Content> content);  // for the library
  const Content& content() const { return *content_; }      // for the library

 private:
  std::shared_ptr<const Content> content_;
};

// Plans the path. Errors: "plan.*", with the number of the piece as line.
PASSO_EXPORTED Outcome<Motion> plan(const Path& path, const Limits& limits);

}  // namespace passo::v1
