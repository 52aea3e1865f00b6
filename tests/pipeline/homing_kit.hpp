// A machine with switches, and what must be true after homing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/step_log.hpp"

#include "passo/plant/ideal_plant.hpp"

namespace passo::test {

// The Uno's router with X and Y homed at their low ends and Z at its high one; Y's motor turns the other way.
inline MachineDescription homing_machine(const std::string& name = "uno") {
  MachineDescription machine = example_machine(name);
  machine.board.highest_event_rate = Hertz(100'000);  // slow enough for all boards
  machine.axes[1].inverted = true;
  for (std::size_t m = 0; m < 3; ++m) {
    const bool high = m == 2;
    const AxisDescription& axis = machine.axes[m];
    machine.axes[m].home = HomeDescription{.toward_high = high,
                                           .switch_at = high ? axis.travel_high + 0.4 : axis.travel_low - 0.4,
                                           .seek = MmPerSecond(20),
                                           .latch = MmPerSecond(1),
                                           .pull_off = 1,
                                           .input = static_cast<int>(m)};
  }
  machine.homing = {Axis::z, Axis::x, Axis::y};
  return machine;
}

// How far the switch of each axis is from where the machine stands: from its side that is open, in steps along the
// homing direction; below 0 the machine is on it.
struct Distances {
  std::int64_t steps[3] = {2000, 3000, 1000};
  std::int64_t hysteresis = 30;
  Seconds bounce{0};
};

inline TravelSwitch switch_of(const MachineDescription& machine, std::size_t motor, const Distances& distances) {
  const AxisDescription& axis = machine.axes[motor];
  const bool high = axis.home->toward_high != axis.inverted;
  const std::int64_t closes = high ? distances.steps[motor] : -distances.steps[motor];
  return {.input = static_cast<std::uint16_t>(1U << static_cast<unsigned>(axis.home->input)),
          .motor = static_cast<std::uint8_t>(motor),
          .at_high_end = high,
          .closes_at = closes,
          .opens_at = high ? closes - distances.hysteresis : closes + distances.hysteresis,
          .bounce = distances.bounce};
}

inline std::vector<TravelSwitch> switches_of(const MachineDescription& machine, const Distances& distances) {
  std::vector<TravelSwitch> switches;
  for (std::size_t m = 0; m < 3; ++m) switches.push_back(switch_of(machine, m, distances));
  return switches;
}

inline IdealPlant plant_with(const std::vector<TravelSwitch>& switches) {
  IdealPlant plant;
  for (const TravelSwitch& one : switches) plant.add(one);
  return plant;
}

struct Homed {
  bool done = false;
  std::optional<MachineFault> fault;
  std::optional<LinkError> error;
  Point place;
  std::vector<HomedAxis> axes;
  std::array<std::int64_t, StepLog::motors> counts{};  // of the motors' pulses
  StepLog::Steps steps;
  std::uint64_t frames = 0;
  int recoveries = 0;
  std::uint16_t inputs = 0;
  Seconds longest_ahead{0};
};

inline void note(const DrivenHoming& homing, Homed& result) {
  result.done = homing.done();
  result.fault = homing.path().homing_fault();
  result.error = homing.drive().link().error();
  result.place = homing.place();
  result.axes = homing.path().homed();
  const QueueUpdateLedger* const ledger = homing.drive().ledger();
  if (ledger == nullptr) return;
  result.recoveries = ledger->recoveries();
  result.longest_ahead = ledger->longest_ahead();
}

// Along the direction of homing, from where the axis stood.
inline double way_of(const AxisDescription& axis, std::int64_t count) {
  const bool forward = axis.home->toward_high != axis.inverted;
  return static_cast<double>(forward ? count : -count);
}

// How far an axis has gone on after its switch closed, in millimetres. From a switch that was already closed the axis
// goes no further. The way has the same bound as that of a probe move.
inline double expect_small_overrun(const MachineDescription& machine, const Distances& distances, const Homed& result) {
  double largest = 0;
  for (std::size_t m = 0; m < 3; ++m) {
    const AxisDescription& axis = machine.axes[m];
    double farthest = 0;
    for (const StepLog::Step& step : result.steps[m]) farthest = std::max(farthest, way_of(axis, step.place[m]));
    const double closed = std::max(static_cast<double>(distances.steps[m]), 0.0);
    const double overrun = (farthest - closed) / axis.steps_per_unit;
    const double speed = axis.home->seek.value();
    const double blind = result.longest_ahead > Seconds(0) ? 2 * result.longest_ahead.value() : 0.007;
    const double slowest = axis.acceleration_at(axis.velocity).value();
    EXPECT_LE(overrun, speed * blind + speed * speed / (2 * slowest) + 2 / axis.steps_per_unit) << "motor " << m;
    largest = std::max(largest, overrun);
  }
  return largest;
}

// The machine stands where it says, to the step, and a pull-off away from each switch.
inline void expect_homed(const MachineDescription& machine, const Distances& distances, const Homed& result) {
  ASSERT_FALSE(result.error) << message_of(*result.error);
  ASSERT_FALSE(result.fault) << row_of(*result.fault).sentence;
  ASSERT_TRUE(result.done);
  for (std::size_t m = 0; m < 3; ++m) {
    SCOPED_TRACE("motor " + std::to_string(m));
    const AxisDescription& axis = machine.axes[m];
    const double sign = axis.home->toward_high ? 1 : -1;
    const double off = static_cast<double>(distances.steps[m]) - way_of(axis, result.counts[m]);
    EXPECT_NEAR(off, axis.home->pull_off * axis.steps_per_unit, 1);
    EXPECT_NEAR(result.place[axis.axis], axis.home->switch_at - sign * off / axis.steps_per_unit, 1e-9)
        << "to the step";
  }
}

}  // namespace passo::test
