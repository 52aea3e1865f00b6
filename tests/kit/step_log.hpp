// StepLog: every step of a run. The functions below check a run over a disturbed link: the machine must follow the same
// path as without disturbances, and stay within its limits.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "passo/machine/machine_observer.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo::test {

// Every step of a run, as executed by the machine.
class StepLog final : public MachineObserver {
 public:
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
    for (unsigned m = 0; m < motors; ++m) {
      if ((stepped >> m & 1U) != 0) add(time.count, m, (directions >> m & 1U) != 0);
    }
    for (unsigned m = 0; m < motors; ++m) {
      if ((stepped >> m & 1U) != 0) steps[m].back().place = place;
    }
  }
  void add(std::int64_t tick, unsigned motor, bool down) {
    place[motor] += down ? -1 : 1;
    steps[motor].push_back({.tick = tick, .down = down, .place = place});
  }

  static constexpr unsigned motors = 5;
  struct Step {
    std::int64_t tick = 0;
    bool down = false;
    std::array<std::int64_t, motors> place{};  // positions of all motors after the step
  };
  std::array<std::int64_t, motors> place{};
  using Steps = std::array<std::vector<Step>, motors>;
  Steps steps;
};

// Expects the same steps in the same order as in `reference`, the undisturbed run. At each step the other motors must
// be at the same positions as in the reference, within a few steps. A motor that reverses exactly where a step is due
// may make the step and undo it within an event or two, or omit it. Therefore one run may have at most `most_touches`
// such pairs of steps that the other run lacks.
inline void expect_same_way(const StepLog::Steps& run, const StepLog::Steps& reference, int most_touches = 0) {
  constexpr std::int64_t beside = 3;  // tolerance for the other motors, in steps, e.g. where both stop
  int touches = 0;
  const auto is_touch = [](const std::vector<StepLog::Step>& steps, std::size_t i) {
    return i + 1 < steps.size() && steps[i].down != steps[i + 1].down;
  };
  for (unsigned m = 0; m < StepLog::motors; ++m) {
    std::size_t i = 0;
    std::size_t k = 0;
    while (i < run[m].size() || k < reference[m].size()) {
      const bool both = i < run[m].size() && k < reference[m].size();
      if (!both || run[m][i].down != reference[m][k].down) {
        ASSERT_LT(touches++, most_touches) << "motor " << m << " step " << i << " of " << run[m].size() << ", step "
                                           << k << " of " << reference[m].size();
        const bool in_reference = is_touch(reference[m], k);
        ASSERT_TRUE(in_reference || is_touch(run[m], i)) << "motor " << m << " step " << i;
        (in_reference ? k : i) += 2;
        continue;
      }
      for (unsigned other = 0; other < StepLog::motors; ++other) {
        const std::int64_t away = run[m][i].place[other] - reference[m][k].place[other];
        if (away < -beside || away > beside) {
          FAIL() << "motor " << other << " is " << away << " steps off at step " << i << " of motor " << m;
        }
      }
      ++i;
      ++k;
    }
  }
}

// The position of a motor at a time, which must not decrease from call to call.
class PlaceAt {
 public:
  PlaceAt(const std::vector<StepLog::Step>& steps, unsigned motor) : steps_(steps), motor_(motor) {}
  double operator()(double tick) {
    while (next_ < steps_.size() && static_cast<double>(steps_[next_].tick) <= tick) ++next_;
    return next_ == 0 ? 0.0 : static_cast<double>(steps_[next_ - 1].place[motor_]);
  }

 private:
  const std::vector<StepLog::Step>& steps_;
  unsigned motor_;
  std::size_t next_ = 0;
};

// Compares positions at equal time intervals. An acceleration limit bounds the second difference of three positions, a
// jerk limit the third difference of four positions.
template <std::size_t count>
void expect_small_differences(const std::vector<StepLog::Step>& steps, unsigned motor,
                              const std::array<int, count>& factors, double window, double most) {
  if (steps.empty()) return;
  std::vector<PlaceAt> places(count, PlaceAt(steps, motor));
  const auto end = static_cast<double>(steps.back().tick);
  const double start = static_cast<double>(steps.front().tick) - static_cast<double>(count - 1) * window;
  for (double tick = start; tick < end; tick += window / 8) {
    double difference = 0;
    for (std::size_t k = 0; k < count; ++k)
      difference += factors[k] * places[k](tick + static_cast<double>(k) * window);
    ASSERT_LE(std::fabs(difference), most) << "motor " << motor << " at tick " << tick << ", of " << count << " places";
  }
}

// `slack`, in steps, allows for two errors. Whole steps cause less than 2. Inexact events cause 4 times the fraction of
// an interval by which an event may be off: at most 4, in a stop ramp (decision 0031). A slack below the sum has been
// sufficient in most cases. In stop ramps of boards with a queue of fewer than 100 items a step may be an event late,
// too (decision 0129), which causes 4 more.
inline void expect_within_limits(const MachineDescription& machine, const StepLog::Steps& run, double slack = 4) {
  constexpr double apart = 0.008;  // seconds
  // The time between two positions for the jerk. A shorter time makes a jump of the acceleration by its limit more
  // visible, but increases the disturbance by whole steps. A longer time does the opposite.
  constexpr double apart_of_four = 0.009;
  const double clock = machine.board.clock.value();
  if (machine.board.held_items < 100) slack += 4;
  for (unsigned m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const double steps = std::fabs(axis.steps_per_unit);
    // Twice the start-stop velocity: within the interval one jump may follow another, each at most that large.
    const double bend = (axis.acceleration.value() * apart + 2 * axis.start_stop.value()) * steps * apart;
    expect_small_differences<3>(run[m], m, {1, -2, 1}, clock * apart, bend * 1.02 + slack);
    // The stop ramp of a small board has no jerk limits (decision 0108).
    const bool has_gentle_tails = machine.board.held_items >= 200;
    if (axis.jerk.value() == 0 || !has_gentle_tails) continue;
    const double jolt = axis.jerk.value() * steps * apart_of_four * apart_of_four * apart_of_four;
    // Whole steps account for 4 of this slack: the factors add up to 8. An event is off by at most a quarter of its
    // interval, which causes 2. A stop ramp over a link does not wait for its exact end (Exactness::ends_in_time), so
    // motion may begin when less than half a step of the stop ramp is left: 2.
    expect_small_differences<4>(run[m], m, {-1, 3, -3, 1}, clock * apart_of_four, jolt * 1.02 + 8);
  }
}

}  // namespace passo::test
