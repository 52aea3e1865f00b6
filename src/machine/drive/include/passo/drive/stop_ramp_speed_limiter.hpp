// StopRampSpeedLimiter: limits the path speed so that the stop ramps (tails) fit into the board's queue.
//
// Where stop ramps get long, the speed is limited so that they fit; after a while with short ones, the limit is raised
// or removed. If not even the first stop ramp after a stop fits, the motion is started more slowly.
#pragma once

#include <cstddef>
#include <limits>

#include "passo/trajectory/phase.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class StopRampSpeedLimiter {
 public:
  // `places`: the board's queue places. A queue update has at least `least_refill` items. The planner must outlive this
  // object.
  StopRampSpeedLimiter(Planner& planner, std::size_t places, std::size_t least_refill);

  struct Speed {
    double on_path = 0;  // mm/s, or degrees/s if only rotary axes move
    double of_axis = 0;  // of the fastest axis, mm/s or degrees/s
  };
  // Records motion emitted by the planner.
  void record_given(const PlannedMove& move);
  // The speed at the end of that motion.
  const Speed& speed() const { return speed_; }
  // Records the time of pulled motion.
  void record_motion(Seconds time) { limited_for_ += time; }
  // Processes the number of items of the stop ramp after the last pulled item.
  void record_tail(std::size_t items);
  // Call at standstill, if none of the pulled motion fits. `highest` has the highest speeds of that motion. Returns
  // false if the motion cannot be slower.
  [[nodiscard]] bool begin_more_slowly(const Speed& highest);
  // Call when the machine has stopped.
  void rest() { speed_ = {}; }
  // How often the speed was limited.
  int slowdowns() const { return slowdowns_; }

 private:
  void limit_to(double speed);

  Planner& planner_;
  std::size_t long_tail_;  // items: longer stop ramps leave too few places
  Speed speed_;            // at the end of the planned motion
  double limit_ = std::numeric_limits<double>::infinity();
  Seconds limited_for_{0};  // time of pulled motion under the limit
  int slowdowns_ = 0;
};

}  // namespace passo
