// SpeedForTails: how fast the path may go so that its braking tails fit into the board.
//
// Where tails get long the speed is limited before they no longer fit; where they have been short for a while the limit
// rises, or goes. Where not even the first tail of a stretch fits, the stretch is begun more slowly.
#pragma once

#include <cstddef>
#include <limits>

#include "passo/trajectory/phase.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class SpeedForTails {
 public:
  // `places`: of the board, for items. A refill has at least `least_refill` of them. The planner outlives this.
  SpeedForTails(Planner& planner, std::size_t places, std::size_t least_refill);

  struct Speed {
    double on_path = 0;  // mm/s, or degrees/s where only rotary axes move
    double of_axis = 0;  // of the axis that moves the most, mm/s or degrees/s
  };
  // The planner has given that motion.
  void record_given(const PlannedMove& move);
  // At its end.
  const Speed& speed() const { return speed_; }
  // So much motion was pulled since.
  void record_motion(Seconds time) { limited_for_ += time; }
  // Behind what was pulled last a tail would have so many items.
  void record_tail(std::size_t items);
  // From rest, where none of the motion fits that was pulled. `highest` has the highest speeds of that motion. False:
  // the motion is as slow as can be already.
  [[nodiscard]] bool begin_more_slowly(const Speed& highest);
  // The machine rests.
  void rest() { speed_ = {}; }
  // How often the speed was limited.
  int slowdowns() const { return slowdowns_; }

 private:
  void limit_to(double speed);

  Planner& planner_;
  std::size_t long_tail_;  // items: longer tails leave too few places
  Speed speed_;            // at the end of what the planner has given
  double limit_ = std::numeric_limits<double>::infinity();
  Seconds limited_for_{0};  // of motion that was pulled
  int slowdowns_ = 0;
};

}  // namespace passo
