// Checks a program for a machine: errors and warnings with their places, the run time, the extents, what limits the
// speed, and whether the motors lose steps. The results are those of `passo check`.
//
// Threads: a Machine never changes, so several threads may use it at once. Several threads may call any function at
// once. check() itself uses up to three threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/library/axes.hpp"
#include "passo/library/finding.hpp"
#include "passo/library/gcode.hpp"
#include "passo/library/motion.hpp"

namespace passo::v1 {

// The content of a machine file. Copies share it.
class PASSO_EXPORTED Machine {
 public:
  // Errors: "machine.*", all errors of the file.
  static Outcome<Machine> open(const std::string& path);
  // `name` is the file name in findings.
  static Outcome<Machine> from_text(std::string_view text, const std::string& name = "machine");

  const std::string& name() const;
  std::vector<Axis> axes() const;
  Limits limits() const;
  StepOptions step_options() const;
  // Whether the file describes a motor. Only then can check() predict lost steps.
  bool knows_motors() const;

  struct Content;
  explicit Machine(std::shared_ptr<const Content> content);  // for the library
  const Content& content() const { return *content_; }       // for the library

 private:
  std::shared_ptr<const Content> content_;
};

struct CheckOptions {
  ReadOptions read = {};
  // False: the check finds only errors and warnings, in a third of the time.
  bool plans = true;
  // Overrides of feed and rapids: 0.01 to 2, and 0.01 to 1.
  double feed_factor = 1;
  double rapid_factor = 1;
  // check() calls this from time to time, in the caller's thread, with the completed fraction, 0 to 1. An exception
  // from it ends the check and reaches the caller.
  std::function<void(double)> progress = {};
};

// The range of an axis, in mm or degrees.
struct AxisRange {
  double low = 0;
  double high = 0;
};
// The motion of an axis.
struct AxisMotion {
  Axis axis = Axis::x;
  std::optional<AxisRange> extents = {};          // in machine coordinates; empty: the axis does not move
  std::optional<AxisRange> cutting_extents = {};  // the same for the feed moves
  double highest_mm_per_s = 0;
  double highest_mm_per_s2 = 0;
};
// What limited the speed, and for how long.
struct SpeedLimit {
  std::string limit = {};  // e.g. "the programmed feed" or "the velocity of X"
  double time_s = 0;
  std::uint32_t first_line = 0;  // the first line with this limit
};
// A line of the program that is slower than programmed.
struct SlowLine {
  std::uint32_t line = 0;
  double mean_mm_per_s = 0;
  double programmed_mm_per_s = 0;
  double lost_s = 0;
  std::string limit = {};  // the one that costs the most time
};

enum class StepVerdict : std::uint8_t { safe, doubtful, lost };
// The worst moment of an axis in a line.
struct WeakSpot {
  Axis axis = Axis::x;
  std::uint32_t line = 0;
  double time_s = 0;
  StepVerdict verdict = StepVerdict::safe;
  double load = 0;         // the torque needed, as a fraction of the guaranteed torque
  std::string cause = {};  // e.g. "Y needs 0.31 N·m at 1,420 steps/s, and has 0.28 to 0.40"
  std::string cure = {};   // e.g. "a <= 380 mm/s², or F <= 900"; may be empty
};

// The results of planning.
struct MotionReport {
  double cutting_time_s = 0;
  double rapid_time_s = 0;
  double dwell_time_s = 0;
  double cutting_length_mm = 0;
  double rapid_length_mm = 0;
  std::uint64_t moves = 0;
  std::uint64_t tool_changes = 0;
  std::vector<AxisMotion> axes = {};
  std::vector<SpeedLimit> speed_limits = {};  // the longest first
  std::vector<SlowLine> slowest_lines = {};   // the most lost time first; at most 5
  // Empty: the machine file describes no motor.
  std::optional<StepVerdict> motors = {};
  std::vector<WeakSpot> weak_spots = {};  // the worst first; at most 10

  double time_s() const { return cutting_time_s + rapid_time_s + dwell_time_s; }
};

struct ProgramReport {
  std::vector<Finding> findings = {};       // errors and warnings; at most 20 errors
  std::optional<MotionReport> motion = {};  // empty: the program has errors, or was not planned

  // Whether there is no error. Lost steps are not an error of the program: see MotionReport::motors.
  bool good() const {
    for (const Finding& finding : findings) {
      if (finding.severity == Severity::error) return false;
    }
    return true;
  }
};

PASSO_EXPORTED ProgramReport check(const Program& program, const Machine& machine, const CheckOptions& options = {});

// Plans the motion of a program on the machine. Its states are in machine coordinates. Spindle commands, tool changes
// and program stops take no time. Errors: those of check(), and "plan.too-long".
PASSO_EXPORTED Outcome<Motion> plan(const Program& program, const Machine& machine, const CheckOptions& options = {});

}  // namespace passo::v1
