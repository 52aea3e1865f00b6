// LimitWatch: monitors a machine's steps and checks that the axes stay within their velocity and acceleration limits.
// It takes constant memory, for runs of any length. StepLog makes the same checks for a run whose steps are all kept in
// memory.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "passo/machine/machine_observer.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo::test {

// Compares positions at equal time intervals. An acceleration limit bounds the second difference of three positions.
class LimitWatch final : public MachineObserver {
 public:
  explicit LimitWatch(const MachineDescription& machine)
      : machine_(machine), sample_ticks_(std::llround(machine.board.clock.value() * apart / samples_apart)) {}

  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
    look_until(time);
    for (unsigned m = 0; m < motors; ++m) {
      if ((stepped >> m & 1U) == 0) continue;
      place_[m] += (directions >> m & 1U) != 0 ? -1 : 1;
      ++steps_;
    }
  }
  // Checks up to `now`. No motor has stepped since the last call of on_steps().
  void look_until(Ticks now) {
    // After such a long standstill all positions are equal, so they need not be compared one by one.
    if (now.count - next_ > 4 * samples * sample_ticks_) forget(Ticks{now.count - 2 * sample_ticks_});
    for (; next_ < now.count; next_ += sample_ticks_) sample();
  }
  // Must be called when the motors were stopped instantly. Positions before that are not compared with positions after
  // it.
  void forget(Ticks now) {
    for (auto& places : places_) places.fill(0);
    for (unsigned m = 0; m < motors; ++m) places_[m].fill(place_[m]);
    next_ = now.count + sample_ticks_;
  }

  std::int64_t steps() const { return steps_; }
  const std::optional<std::string>& violation() const { return violation_; }

 private:
  static constexpr double apart = 0.008;  // seconds between two compared positions
  static constexpr int samples_apart = 8;
  static constexpr unsigned samples = 2 * samples_apart + 1;
  static constexpr unsigned motors = 5;
  // In steps. Whole steps cause 2. In the stop ramp of a board with a small queue an event may be off by a whole
  // interval, which causes 4.
  static constexpr double slack = 6;

  void sample() {
    ++at_;
    for (unsigned m = 0; m < machine_.axes.size(); ++m) {
      places_[m][at_ % samples] = place_[m];
      const auto before = [&](unsigned ago) {
        return static_cast<double>(places_[m][(at_ + samples - ago * samples_apart) % samples]);
      };
      const AxisDescription& axis = machine_.axes[m];
      const double scale = std::fabs(axis.steps_per_unit);
      const double way = std::fabs(before(0) - before(1));
      const double bend = std::fabs(before(0) - 2 * before(1) + before(2));
      const double longest = axis.velocity.value() * scale * apart * 1.01 + 2;
      const double most = axis.acceleration.value() * scale * apart * apart * 1.02 + slack;
      if ((way <= longest && bend <= most) || violation_) continue;
      violation_ =
          fmt::format("motor {} at tick {}: {} steps in {} s, at most {:.1f}; they differ by {}, at most {:.1f}", m,
                      next_, way, apart, longest, bend, most);
    }
  }

  const MachineDescription& machine_;
  std::int64_t sample_ticks_;
  std::array<std::int64_t, motors> place_{};
  std::array<std::array<std::int64_t, samples>, motors> places_{};
  unsigned at_ = 0;
  std::int64_t next_ = 0;
  std::int64_t steps_ = 0;
  std::optional<std::string> violation_;
};

}  // namespace passo::test
