// MotionTimes: how long the planned motion of a program takes from each of its points, with its ramps and with the
// overrides in force. So the time left of a job is known to the second. MotionTimer works them out beside the machine.
//
// Place: beside the program store. A point of a program is told by its nominal time (activity/nominal_time.hpp), as
// the session tells progress. Bounded: in a long program the points that are kept lie farther apart.
#pragma once

#include <cstddef>
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

  // What was planned so far, from the beginning of the program; both times grow.
  void add(Seconds nominal, Seconds planned);
  Seconds whole() const { return last_.planned; }
  // How long the motion takes from that point on.
  Seconds left_from(Seconds nominal) const;
  std::size_t points() const { return points_.size(); }

 private:
  struct Point {
    Seconds nominal{0};
    Seconds planned{0};
  };
  std::vector<Point> points_{Point()};
  Point last_;
  Seconds apart_{0};  // the least planned time between two points
};

// A program that was checked, and is to be timed.
struct MotionTiming {
  std::string name;
  std::string text;
  InterpreterOptions options;
  ProgramCheck check;
  MotionFactors factors;
};

// Plans the whole motion. Empty: `goes_on`, which is asked again and again, said no.
std::optional<MotionTimes> time_motion(const MotionTiming& wanted, const MachineDescription& machine,
                                       const std::function<bool()>& goes_on);

// Times programs beside the machine. A new order takes the place of the one before.
class MotionTimer {
 public:
  virtual ~MotionTimer() = default;
  virtual void begin(MotionTiming wanted) = 0;
  // What was found of the last order, once.
  virtual std::optional<MotionTimes> take_times() = 0;
};

}  // namespace passo
