// StepLog: every step of a run, and what must be true of it where a line is troubled: the machine goes the same way,
// and within its limits.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "passo/machine/machine_observer.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo::test {

// Every step of a run as the machine made it.
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

  static constexpr unsigned motors = 3;
  struct Step {
    std::int64_t tick = 0;
    bool down = false;
    std::array<std::int64_t, motors> place{};  // of all motors behind it
  };
  std::array<std::int64_t, motors> place{};
  using Steps = std::array<std::vector<Step>, motors>;
  Steps steps;
};

// The same steps in the same order as without trouble, each with the other motors where they were then.
inline void expect_same_way(const StepLog::Steps& run, const StepLog::Steps& reference) {
  constexpr std::int64_t beside = 3;  // steps of another motor: both come to rest at times
  for (unsigned m = 0; m < StepLog::motors; ++m) {
    ASSERT_EQ(run[m].size(), reference[m].size()) << "motor " << m;
    for (std::size_t i = 0; i < run[m].size(); ++i) {
      ASSERT_EQ(run[m][i].down, reference[m][i].down) << "motor " << m << " step " << i;
      for (unsigned other = 0; other < StepLog::motors; ++other) {
        ASSERT_NEAR(static_cast<double>(run[m][i].place[other]), static_cast<double>(reference[m][i].place[other]),
                    beside)
            << "motor " << other << " at step " << i << " of motor " << m;
      }
    }
  }
}

// Three places at equal times apart: where the acceleration is bounded, so is their second difference. `slack`, in
// steps: for they are whole ones (less than 2), and events are not exact: 4 times the part of an interval by which they
// may be off (decision 0031: 4 in a tail at the most; less has been enough for most).
inline void expect_within_limits(const MachineDescription& machine, const StepLog::Steps& run, double slack = 4) {
  const double window = machine.board.clock.value() * 0.008;
  for (unsigned m = 0; m < StepLog::motors; ++m) {
    const AxisDescription& axis = machine.axes[m];
    const auto& steps = run[m];
    if (steps.empty()) continue;
    std::array<std::size_t, 3> at{};
    const auto place = [&](std::size_t k, double tick) {
      while (at[k] < steps.size() && static_cast<double>(steps[at[k]].tick) <= tick) ++at[k];
      return at[k] == 0 ? 0.0 : static_cast<double>(steps[at[k] - 1].place[m]);
    };
    const double most = axis.acceleration.value() * std::fabs(axis.steps_per_unit) * 0.008 * 0.008;
    const auto end = static_cast<double>(steps.back().tick);
    for (double tick = static_cast<double>(steps.front().tick) - 2 * window; tick < end; tick += window / 8) {
      const double bend = place(0, tick) - 2 * place(1, tick + window) + place(2, tick + 2 * window);
      ASSERT_LE(std::fabs(bend), most * 1.02 + slack) << "motor " << m << " at tick " << tick;
    }
  }
}

}  // namespace passo::test
