// Random programs as text, and random machines, for tests of all stages together. Each program is short and has no
// error. It has the elements of real programs: lines, arcs, helices, curves, very short lines, many close points,
// cycles, modes, units, feeds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

#include "kit/in_full.hpp"
#include "kit/seed.hpp"
#include "kit/stage_test.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/machine_file/machine_description.hpp"

namespace passo::test {

// Returns a motor whose torque decreases above some speed. At standstill the motor provides at least the axis's
// acceleration, at full speed only a part of it.
inline AxisMotor random_motor(Random& random, const AxisDescription& axis) {
  const Rotor rotor{.inertia = {1e-5}};
  const double at_rest = axis.acceleration.value() * random.between(1, 1.5);
  const double at_speed = axis.acceleration.value() * random.between(0.1, 0.7);
  const auto point = [&](double speed, double acceleration) {
    return TorquePoint{.rate = Hertz(speed * rotor.steps_per_revolution / (2 * std::numbers::pi)),
                       .torque = {acceleration * rotor.inertia.value}};
  };
  const double top = axis.velocity.value();
  const Result<TorqueCurve, MotorError> curve =
      TorqueCurve::from_points(rotor, {point(top * random.between(0.05, 0.6), at_rest),
                                       point(top * random.between(0.7, 1), at_speed), point(1.2 * top, at_speed / 2)});
  return {.curve = *curve, .share = 1, .radians_per_unit = 1};
}

// Returns a machine with two to five axes, sluggish or nimble. Some machines have jerk limits, and some have torque
// curves.
inline MachineDescription random_machine(Random& random) {
  static constexpr std::array order = {Axis::x, Axis::y, Axis::z, Axis::a, Axis::c};
  MachineDescription machine;
  machine.name = "random";
  machine.path_tolerance = Mm(std::exp(random.between(-7, -2)));
  machine.board.highest_event_rate = Hertz(random.chance(0.5) ? 100e3 : 1e6);
  machine.tool.highest_rpm = 24'000;
  const auto count = static_cast<std::size_t>(random.between(2, 5.999));
  const double velocity = std::exp(random.between(3, 6));
  const double acceleration = std::exp(random.between(4.5, 9));
  const double rise = random.chance(0.5) ? 0 : random.chance(0.5) ? 0.02 : std::exp(random.between(-6, -2));
  const double steps = std::exp(random.between(1, 4.5));
  for (std::size_t i = 0; i < count; ++i) {
    AxisDescription axis;
    axis.axis = order[i];
    axis.steps_per_unit = steps * (random.chance(0.5) ? 1 : std::exp(random.between(-1.5, 1.5)));
    axis.velocity = MmPerSecond(velocity * (random.chance(0.5) ? 1 : random.between(0.2, 1)));
    axis.velocity =
        std::min(axis.velocity, MmPerSecond(0.9 * machine.board.highest_event_rate.value() / axis.steps_per_unit));
    axis.acceleration = MmPerSecond2(acceleration * (random.chance(0.5) ? 1 : random.between(0.2, 1)));
    if (rise > 0) axis.jerk = MmPerSecond3(axis.acceleration.value() / rise);
    axis.travel_low = -1e5;
    axis.travel_high = 1e5;
    machine.axes.push_back(axis);
  }
  if (random.chance(0.25)) {
    for (AxisDescription& axis : machine.axes) axis.motor = random_motor(random, axis);
  }
  return machine;
}

// Gives a third of the machines jerk limits on some of their axes, removes them from the others, and gives a third of
// the machines a rotary axis if they have none. `number` is that of the job; the other random choices for it do not
// change.
inline void mix_limits(std::uint64_t number, MachineDescription& machine) {
  Random random = Random::of(number ^ 0x6d6978);
  const double rise = std::exp(random.between(-6, -2));
  for (AxisDescription& axis : machine.axes) axis.jerk = MmPerSecond3(0);
  if (number % 3 == 0) {
    const auto sure = static_cast<std::size_t>(random.between(0, static_cast<double>(machine.axes.size())));
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
      if (i != sure && !random.chance(0.5)) continue;
      machine.axes[i].jerk = MmPerSecond3(machine.axes[i].acceleration.value() / rise);
    }
  }
  const bool turns = std::ranges::any_of(machine.axes, [](const auto& axis) { return is_rotary(axis.axis); });
  if (number / 3 % 3 != 0 || turns) return;
  AxisDescription axis = machine.axes.back();
  axis.axis = Axis::a;
  machine.axes.push_back(axis);
}

// Gives most axes a start-stop velocity. One machine in five keeps its jerk limits.
inline void give_starts(std::uint64_t number, MachineDescription& machine) {
  Random random = Random::of(number ^ 0x737461);
  for (AxisDescription& axis : machine.axes) {
    if (number % 5 != 0) axis.jerk = MmPerSecond3(0);
    if (random.chance(0.8)) axis.start_stop = axis.velocity * random.between(0.01, 0.3);
  }
}

// Gives any of the axes jerk limits, a torque curve and backlash, each independently, and gives half of the machines a
// rotary axis if they have none.
inline void mix_everything(std::uint64_t number, MachineDescription& machine) {
  Random random = Random::of(number ^ 0x616c6c);
  const bool turns = std::ranges::any_of(machine.axes, [](const auto& axis) { return is_rotary(axis.axis); });
  if (!turns && random.chance(0.5)) {
    AxisDescription axis = machine.axes.back();
    axis.axis = Axis::a;
    axis.velocity = std::min(axis.velocity, MmPerSecond(std::exp(random.between(2, 5))));
    machine.axes.push_back(axis);
  }
  const double rise = std::exp(random.between(-6, -2));
  for (AxisDescription& axis : machine.axes) {
    axis.jerk = random.chance(0.5) ? axis.acceleration / Seconds(rise * random.between(0.5, 2)) : MmPerSecond3(0);
    axis.motor.reset();
    if (random.chance(0.25)) axis.motor = random_motor(random, axis);
    if (random.chance(0.2)) axis.screw = ScrewDescription{.backlash = std::exp(random.between(-5, -1))};
  }
}

// All of that, and start-stop velocities on any of the axes of a third of the machines.
inline void mix_with_starts(std::uint64_t number, MachineDescription& machine) {
  mix_everything(number, machine);
  Random random = Random::of(number ^ 0x737473);
  if (!random.chance(0.33)) return;
  for (AxisDescription& axis : machine.axes) {
    if (random.chance(0.5)) axis.start_stop = axis.velocity * random.between(0.01, 0.3);
  }
}

class RandomGcode {
 public:
  // `turning`: degrees that a rotary axis moves where another axis would move by a millimetre.
  RandomGcode(Random& random, const MachineDescription& machine, double turning = 1)
      : random_(random), machine_(machine), turning_(turning) {}

  std::string draw() {
    say("G21 G90 G17 F{:.1f}", feed());
    path_mode();
    size_ = std::exp(random_.between(-3, 2));
    const int pieces = static_cast<int>(random_.between(1, 8));
    for (int i = 0; i < pieces; ++i) piece();
    say("M2");
    return text_;
  }

 private:
  template <typename... Values>
  void say(fmt::format_string<Values...> words, Values&&... values) {
    text_ += fmt::format(words, std::forward<Values>(values)...) + "\n";
  }
  double feed() { return std::exp(random_.between(5.5, 10.5)); }
  double way() { return size_ * random_.between(-1, 1); }
  bool has(Axis axis) const {
    return std::ranges::any_of(machine_.axes, [&](const AxisDescription& one) { return one.axis == axis; });
  }

  void path_mode() {
    const double kind = random_.between(0, 1);
    const double tolerance = std::exp(random_.between(-7, -1));
    if (kind < 0.1) return say("G61");
    if (kind < 0.15) return say("G61.1");
    if (kind < 0.4) return say("G64 P{:.4f}", tolerance);
    if (kind < 0.6) return say("G64 P{:.4f} Q{:.4f}", tolerance, tolerance * random_.between(0.1, 1));
  }

  void piece() {
    const double kind = random_.between(0, 1);
    if (kind < 0.3) return corners();
    if (kind < 0.45) return arc();
    if (kind < 0.55) return curve();
    if (kind < 0.65) return chords();
    if (kind < 0.72) return dust();
    if (kind < 0.78) return cycle();
    if (kind < 0.84) return inverse_time();
    if (kind < 0.88) return inches();
    if (kind < 0.92) return path_mode();
    if (kind < 0.96) return say("F{:.1f}", feed());
    if (kind < 0.98) return say("G4 P{:.3f}", random_.between(0, 0.2));
    say("M3 S{:.0f} M8", random_.between(100, 20'000));
  }

  void line(const char* word) {
    std::string words = word;
    for (const AxisDescription& axis : machine_.axes) {
      if (!random_.chance(0.6)) continue;
      place_[axis.axis] += way() * (is_rotary(axis.axis) ? turning_ : 1);
      words += fmt::format(" {}{:.4f}", letter_of(axis.axis), place_[axis.axis]);
    }
    if (words != word) say("{}", words);
  }
  void corners() {
    const int lines = static_cast<int>(random_.between(1, 6));
    for (int i = 0; i < lines; ++i) line(random_.chance(0.2) ? "G0" : "G1");
  }

  // Appends arcs, full circles, helices and spirals.
  void arc() {
    const double radius = size_ * std::exp(random_.between(-2, 0.5));
    const double from = random_.between(-std::numbers::pi, std::numbers::pi);
    const double to = from + random_.between(0.05, 6.2) * (random_.chance(0.5) ? 1 : -1);
    const double i = -radius * std::cos(from);
    const double j = -radius * std::sin(from);
    const bool full = random_.chance(0.15);
    if (!full) {
      place_[Axis::x] += i + radius * std::cos(to);
      place_[Axis::y] += j + radius * std::sin(to);
    }
    std::string words = fmt::format("{} X{:.6f} Y{:.6f} I{:.6f} J{:.6f}", to > from ? "G3" : "G2", place_[Axis::x],
                                    place_[Axis::y], i, j);
    if (has(Axis::z) && random_.chance(0.4)) words += fmt::format(" Z{:.4f}", place_[Axis::z] += way());
    if (has(Axis::a) && random_.chance(0.2)) words += fmt::format(" A{:.4f}", place_[Axis::a] += way());
    if (random_.chance(0.1)) words += " P2";
    say("{}", words);
  }
  void curve() {
    const double i = way(), j = way(), p = way(), q = way();
    place_[Axis::x] += way();
    place_[Axis::y] += way();
    say("G5 I{:.4f} J{:.4f} P{:.4f} Q{:.4f} X{:.4f} Y{:.4f}", i, j, p, q, place_[Axis::x], place_[Axis::y]);
  }
  // Appends chords like those of CAM programs.
  void chords() {
    const int count = static_cast<int>(random_.between(3, 60));
    const double step = std::exp(random_.between(-5, -1));
    const double bend = random_.between(-0.3, 0.3);
    double direction = random_.between(0, 6.28);
    for (int i = 0; i < count; ++i) {
      direction += bend + random_.between(-0.05, 0.05);
      place_[Axis::x] += step * std::cos(direction);
      place_[Axis::y] += step * std::sin(direction);
      say("G1 X{:.4f} Y{:.4f}", place_[Axis::x], place_[Axis::y]);
    }
  }
  void dust() {
    const double old = size_;
    size_ = std::exp(random_.between(-8, -3));
    for (int i = 0; i < 8; ++i) line("G1");
    size_ = old;
  }
  void cycle() {
    if (!has(Axis::z)) return;
    const double top = place_[Axis::z];
    const double r = top - std::abs(way());
    const double bottom = r - 0.01 - std::abs(way());
    place_[Axis::x] += way();
    place_[Axis::y] += way();
    if (random_.chance(0.5)) {
      say("G98 G81 X{:.4f} Y{:.4f} Z{:.4f} R{:.4f}", place_[Axis::x], place_[Axis::y], bottom, r);
    } else {
      say("G98 G83 X{:.4f} Y{:.4f} Z{:.4f} R{:.4f} Q{:.4f}", place_[Axis::x], place_[Axis::y], bottom, r,
          0.01 + (r - bottom) / 2);
    }
    say("G80");
  }
  void inverse_time() {
    say("G93");
    place_[Axis::x] += way();
    place_[Axis::y] += way();
    say("G1 X{:.4f} Y{:.4f} F{:.2f}", place_[Axis::x], place_[Axis::y], std::exp(random_.between(4, 7)));
    say("G94 F{:.1f}", feed());
  }
  void inches() {
    const double x = way();
    place_[Axis::x] += x * 25.4;
    say("G20 G91 G1 X{:.6f} F{:.2f}\nG21 G90 F{:.1f}", x, feed() / 25.4, feed());
  }

  Random& random_;
  const MachineDescription& machine_;
  double turning_;
  std::string text_;
  Point place_;
  double size_ = 1;
};

enum class Machines : std::uint8_t { as_drawn, mixed, starting, of_all_mixtures, of_any_limits };

struct RandomJob {
  explicit RandomJob(Random& random) : machine(random_machine(random)), program(RandomGcode(random, machine).draw()) {}
  RandomJob(Random& random, MachineDescription on, double turning = 1)
      : machine(std::move(on)), program(RandomGcode(random, machine, turning).draw()) {}
  // With jerk limits on some axes only, and more rotary axes.
  static RandomJob mixed(std::uint64_t number, Random& random) {
    MachineDescription machine = random_machine(random);
    mix_limits(number, machine);
    return {random, std::move(machine)};
  }
  // With start-stop velocities.
  static RandomJob starting(std::uint64_t number, Random& random) {
    MachineDescription machine = random_machine(random);
    give_starts(number, machine);
    return {random, std::move(machine)};
  }
  // With jerk limits, torque curves and backlash on any axes; some lines are mostly rotary.
  static RandomJob of_all_mixtures(std::uint64_t number, Random& random) {
    MachineDescription machine = random_machine(random);
    mix_everything(number, machine);
    const double turning = number % 2 == 0 ? 1 : std::exp(Random::of(number ^ 0x7475726e).between(0, 7));
    return {random, std::move(machine), turning};
  }
  // The same, with start-stop velocities on any axes.
  static RandomJob of_any_limits(std::uint64_t number, Random& random) {
    MachineDescription machine = random_machine(random);
    mix_with_starts(number, machine);
    const double turning = number % 2 == 0 ? 1 : std::exp(Random::of(number ^ 0x7475726e).between(0, 7));
    return {random, std::move(machine), turning};
  }
  static RandomJob of(Machines machines, std::uint64_t number, Random& random) {
    switch (machines) {
      case Machines::as_drawn: break;
      case Machines::mixed: return mixed(number, random);
      case Machines::starting: return starting(number, random);
      case Machines::of_all_mixtures: return of_all_mixtures(number, random);
      case Machines::of_any_limits: return of_any_limits(number, random);
    }
    return RandomJob(random);
  }
  MachineDescription machine;
  std::string program;
};

// Calls `try_one` for PASSO_RUNS numbers, beginning with PASSO_SEED, each time with the number's job and generator.
// Ends at the first failure. Without PASSO_RUNS there are `runs_otherwise` numbers. Each job depends
// only on its number.
template <class Try>
void for_each_job(int runs_otherwise, const Try& try_one, Machines machines = Machines::as_drawn) {
  const std::uint64_t first = first_seed(1);
  const std::uint64_t runs = number_of("PASSO_RUNS", static_cast<std::uint64_t>(runs_otherwise));
  for (std::uint64_t number = first; number < first + runs && !testing::Test::HasFailure(); ++number) {
    Random random = Random::of(number);
    const RandomJob job = RandomJob::of(machines, number, random);
    SCOPED_TRACE(command_again(number, "PASSO_RUNS=1") + "\n" + describe(job.machine) + job.program);
    if (runs == 1) std::printf("%s%s", describe(job.machine).c_str(), job.program.c_str());
    try_one(number, job, random);
  }
  std::printf("%llu programs from %llu on: %s\n", static_cast<unsigned long long>(runs),
              static_cast<unsigned long long>(first),
              command_again(first, "PASSO_RUNS=" + std::to_string(runs)).c_str());
}

}  // namespace passo::test
