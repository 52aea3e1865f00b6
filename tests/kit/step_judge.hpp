// StepJudge: checks a run by its steps only, against the limits in the machine's description. It shares no code with
// the motion planning and step generation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/step_log.hpp"
#include <fmt/format.h>

#include "passo/machine_file/machine_description.hpp"

namespace passo::test {

// Compares the motor positions at equal time intervals. The mean acceleration over a window cannot exceed the
// acceleration limit, nor can the mean jerk exceed the jerk limit. A short window reveals a short jump, and a long one
// a small excess, because whole steps disturb it less.
class StepJudge {
 public:
  // A stop ramp: the board played its queue after the link was lost, and then stopped.
  struct Tail {
    double from = 0;  // in seconds, like all times
    double to = 0;
  };
  StepJudge(const MachineDescription& machine, const StepLog::Steps& steps, std::vector<Tail> tails = {})
      : machine_(machine), steps_(steps), tails_(std::move(tails)) {
    for (unsigned m = 0; m < machine.axes.size(); ++m) {
      if (steps[m].empty()) continue;
      const double end = static_cast<double>(steps[m].back().tick) / machine.board.clock.value();
      PlaceAt place(steps[m], m);
      const auto count = static_cast<std::int64_t>(end / apart) + 2;
      for (std::int64_t k = 0; k < count; ++k) {
        places_[m].push_back(place(static_cast<double>(k) * apart * machine.board.clock.value()));
      }
    }
  }

  // Returns the first motor that exceeds a limit, and where. Nothing if all limits are kept.
  std::optional<std::string> fault() const {
    for (unsigned m = 0; m < machine_.axes.size(); ++m) {
      for (const int samples : {4, 8, 16, 32}) {
        if (auto found = fault_of(m, samples)) return found;
      }
    }
    return {};
  }

  // Returns the maximum time to stop from these speeds of the axes, with each axis considered separately: the braking
  // time; and for each axis that moves or makes a step between these times, the time to reverse and release its
  // acceleration. An axis may move by less than a step.
  double braking(const std::vector<double>& speeds, double from, double rested) const {
    double most = 0;
    double longest_rise = 0;
    for (unsigned m = 0; m < machine_.axes.size(); ++m) {
      const AxisDescription& axis = machine_.axes[m];
      most = std::max(most, speeds[m] / axis.acceleration_at(MmPerSecond(speeds[m])).value());
      if (axis.jerk.value() == 0 || !(speeds[m] > 0 || steps_between(m, from, rested))) continue;
      longest_rise = std::max(longest_rise, axis.acceleration.value() / axis.jerk.value());
    }
    return most + 2.5 * longest_rise;
  }
  // Returns the time of the last step of any motor, in seconds. 0: none.
  double last_step_before(double time) const {
    const double tick = time * machine_.board.clock.value();
    double last = 0;
    for (const auto& steps : steps_) {
      const auto after = std::upper_bound(
          steps.begin(), steps.end(), tick,
          [](double limit, const StepLog::Step& step) { return limit < static_cast<double>(step.tick); });
      if (after != steps.begin()) last = std::max(last, static_cast<double>(std::prev(after)->tick));
    }
    return last / machine_.board.clock.value();
  }

 private:
  static constexpr double apart = 0.00125;  // seconds
  // In steps. Whole steps cause less than 2 in an acceleration and 4 in a jerk. Events of another motor, at most one
  // step off each, cause the same again.
  static constexpr double slack = 4;
  static constexpr double slack_of_jerk = 8;
  // Stop ramps of a board with a small queue have no jerk limits (decision 0108).
  bool is_in_small_tail(double from, double to) const {
    if (machine_.board.held_items >= 200) return false;
    return std::ranges::any_of(tails_, [&](const Tail& tail) { return from < tail.to && tail.from < to; });
  }
  static constexpr double tolerated = 1.02;

  double at(unsigned motor, std::int64_t sample) const {
    const std::vector<double>& places = places_[motor];
    if (places.empty() || sample < 0) return 0;
    return places[std::min(static_cast<std::size_t>(sample), places.size() - 1)];
  }
  bool steps_between(unsigned motor, double from, double to) const {
    const double clock = machine_.board.clock.value();
    return std::ranges::any_of(steps_[motor], [&](const StepLog::Step& step) {
      const double time = static_cast<double>(step.tick) / clock;
      return from <= time && time <= to;
    });
  }

  std::optional<std::string> fault_of(unsigned motor, int samples) const {
    const AxisDescription& axis = machine_.axes[motor];
    const double window = samples * apart;
    const double steps = axis.steps_per_unit;
    const double farthest = axis.velocity.value() * window * steps * tolerated + 2;
    // At stops the velocity may jump, from one direction to the other.
    const double jumps = 2 * axis.start_stop.value() * window * steps;
    const double jolt = axis.jerk.value() * window * window * window * steps * tolerated + slack_of_jerk + 2 * jumps;
    const auto count = static_cast<std::int64_t>(places_[motor].size()) + 2 * samples;
    for (std::int64_t k = 0; k < count; ++k) {
      const double newest = at(motor, k);
      const double second = at(motor, k - samples);
      const double third = at(motor, k - 2 * samples);
      const double fourth = at(motor, k - 3 * samples);
      const double now = static_cast<double>(k) * apart;
      const auto told = [&](const char* what, double value, double most) {
        return fmt::format("{} of {} over {} ms at {:.4f} s: {:.1f} steps, at most {:.1f}", what, letter_of(axis.axis),
                           window * 1e3, now, value, most);
      };
      const double way = std::abs(newest - second);
      if (way > farthest) return told("way", way, farthest);
      const double bend = std::abs(newest - 2 * second + third);
      const double most = axis.acceleration.value() * window * window * steps * tolerated + slack + jumps;
      if (bend > most) return told("bend", bend, most);
      if (axis.follows_torque()) {
        // The torque is highest where the motor was slowest, which was hardly slower than the mean of both halves.
        const double mean = (newest - second) * (second - third) > 0 ? std::min(way, std::abs(second - third)) - 2 : 0;
        const double slowest = std::max(mean / window / steps - axis.acceleration.value() * window, 0.0);
        const double left = axis.acceleration_at(MmPerSecond(slowest)).value() * window * window * steps * tolerated;
        if (bend > left + slack + jumps) return told("bend at speed", bend, left + slack + jumps);
      }
      const double change = std::abs(newest - 3 * second + 3 * third - fourth);
      if (axis.jerk.value() > 0 && change > jolt && !is_in_small_tail(now - 3 * window, now))
        return told("change of bend", change, jolt);
    }
    return {};
  }

  const MachineDescription& machine_;
  const StepLog::Steps& steps_;
  std::vector<Tail> tails_;
  std::array<std::vector<double>, StepLog::motors> places_;
};

}  // namespace passo::test
