// Plans the motion along a whole path, within the limits of the axes, as states in time or as the steps of motors.
//
//   passo::Path path({.x = 0, .y = 0});
//   path.line_to({.x = 40}, 50);
//   path.line_to({.x = 40, .y = 30}, 50);
//   const passo::Outcome<passo::Motion> motion = passo::plan(path, limits);
//   const passo::MotionState state = motion->at(0.5);
//
// The motion is nearly as fast as the limits of the axes allow. plan() rounds corners within the tolerance of the path,
// so that the tool does not stop there. The motion starts and ends with the speed 0.
//
// Threads: a Path has the rules of a std::vector. A Motion never changes, so several threads may use it at once. Only
// one thread at a time may use a StepTrain.
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

// Lines, arcs and stops. The functions never fail: plan() reports values out of range, with the number of the piece.
//
// Coordinates: -100,000 to 100,000 mm, -10,000,000 to 10,000,000 degrees. At most 1,000,000 pieces.
class PASSO_EXPORTED Path {
 public:
  explicit Path(const Position& start = {});
  Path(const Path& other);
  Path(Path&& other) noexcept;
  Path& operator=(Path other) noexcept;
  ~Path();

  // The largest distance of the rounded path from the given one, at the corners after the pieces that follow: 0 to
  // 100 mm (default: 0.01 mm). 0: the tool stops at each corner.
  void set_tolerance(double tolerance_mm);
  // `speed_mm_per_s`: the highest speed along the path, above 0. If only A, B and C move: degrees per second.
  void line_to(const Position& end, double speed_mm_per_s = unlimited);
  // An arc about a centre, given in the first and second axis of the plane. `turns`: 1 is up to one full circle
  // counterclockwise, 2 is one circle more; -1 is clockwise. From -1000 to 1000, not 0. All other axes move in
  // proportion (helix). If start and end have different distances from the centre, the radius changes in proportion
  // (spiral).
  void arc_to(const Position& end, ArcPlane plane, double first_centre_mm, double second_centre_mm, int turns = 1,
              double speed_mm_per_s = unlimited);
  // Stops at the end of the path so far, for `dwell_s` seconds: 0 to 86,400.
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
  double jerk_mm_per_s3 = 0;  // 0: no limit. With a limit, planning takes several times as long
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
  double speed_mm_per_s = 0;   // along the path; if only A, B and C move: degrees per second
  std::uint32_t piece = 0;     // the number of the piece of the Path, from 1; for a program: the line
};

// The motors of a machine, and the clock of their steps.
struct StepOptions {
  // Steps per millimetre or degree, 0.001 to 1e6; negative: the motor turns in the other direction. 0: no motor. At
  // most 8 motors.
  std::array<double, axis_count> steps_per_mm{};
  double ticks_per_s = 16e6;  // 10,000 to 1e9
  // All steps happen at events. This is the largest number of events per second: ticks_per_s / 32,767 to
  // ticks_per_s / 16. At its velocity limit, no axis may need more steps per second.
  double events_per_s = 1e5;
  double& operator[](Axis axis) { return steps_per_mm[static_cast<std::size_t>(axis)]; }
};

// One step of a motor.
struct Step {
  std::int64_t tick = 0;  // since the start of the motion
  Axis axis = Axis::x;
  bool forward = true;  // the motor's count goes up
};

// All steps of a motion, in order of time. The library computes them while they are read, in constant memory.
//
// The steps of the fastest motor are at the ticks nearest to their exact times. The steps of the other motors wait for
// the next event. While motors move, there are at least events_per_s / 8 events per second.
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
  // The length of the rounded path, to a few parts in a thousand, without moves of A, B and C only.
  double length_mm() const;
  // Returns the state at a time; before the start it is the state at the start, and after the end that at the end.
  MotionState at(double time_s) const;
  // Writes the states at `count` times: from_s, from_s + interval_s and so on. This is faster than at(). `interval_s`
  // is at least 0.
  void sample(double from_s, double interval_s, std::size_t count, MotionState* states) const;
  // Errors: "steps.*".
  Outcome<StepTrain> steps(const StepOptions& options) const;
  // Returns the steps of the motors of the machine for which a program was planned, with compensation of backlash and
  // screw errors. For the motion of a Path this is an error.
  Outcome<StepTrain> steps() const;

  struct Content;
  explicit Motion(std::shared_ptr<const Content> content);  // for the library
  const Content& content() const { return *content_; }      // for the library

 private:
  std::shared_ptr<const Content> content_;
};

// Plans the path. Errors: "plan.*"; their line is the number of the piece.
PASSO_EXPORTED Outcome<Motion> plan(const Path& path, const Limits& limits);

}  // namespace passo::v1
