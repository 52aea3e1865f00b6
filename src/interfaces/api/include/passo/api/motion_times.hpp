// MotionTimes: the duration of a program's planned motion from each of its points, including ramps and the current
// overrides. It gives the remaining time of a job to the second. MotionTimer computes it without blocking the machine.
//
// Position in the pipeline: beside the program store. A point of a program is identified by its nominal time
// (activity/nominal_time.hpp), as in the session's progress reports. Bounded: in a long program the stored points are
// farther apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "passo/activity/program.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/planned_program.hpp"
#include "passo/units/units.hpp"

namespace passo {

class MotionTimes {
 public:
  static constexpr std::size_t most_points = 20'000;

  // Adds the progress of the planning from the beginning of the program; both times must increase.
  void add(Seconds nominal, Seconds planned);
  Seconds whole() const { return last_.planned; }
  // Returns the duration of the motion from that point on.
  Seconds left_from(Seconds nominal) const;
  std::size_t points() const { return points_.size(); }

 private:
  struct Point {
    Seconds nominal{0};
    Seconds planned{0};
  };
  std::vector<Point> points_{Point()};
  Point last_;
  Seconds apart_{0};  // minimum planned time between two points
};

// A checked program whose duration is to be computed.
struct MotionTiming {
  std::string name;
  std::string text;
  InterpreterOptions options;
  ProgramCheck check;
  MotionFactors factors;
};

// Plans the whole motion. Calls `goes_on` repeatedly; returns nothing if it returns false.
std::optional<MotionTimes> time_motion(const MotionTiming& wanted, const MachineDescription& machine,
                                       const std::function<bool()>& goes_on);

// Computes the duration of programs without blocking the machine. A new order replaces the previous one.
class MotionTimer {
 public:
  virtual ~MotionTimer() = default;
  virtual void begin(MotionTiming wanted) = 0;
  // The number of what the times are based on, e.g. the settings of a board that plans its own motion. Another number:
  // earlier times are wrong. 0: nothing can be computed yet.
  virtual std::uint64_t basis() { return 1; }
  // Returns the result of the last order, once.
  virtual std::optional<MotionTimes> take_times() = 0;
};

}  // namespace passo
