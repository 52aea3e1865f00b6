// The motor in motion, compared with closed forms: currents, ringing, holding torque, pull-out, and with its equations
// integrated by another method.
#include "passo/motor/running_motor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "example_motors.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/motor/motor_trials.hpp"
#include "passo/motor/torque_curve.hpp"

namespace passo {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

MotorSetup setup_of(const MotorData& motor, const std::string& excitation, double supply = 24,
                    Regulation regulation = Regulation::chopper) {
  return {.motor = motor,
          .drive = {.supply = {supply}, .regulation = regulation},
          .excitation = *Excitation::named(excitation)};
}

TEST(RunningMotor, has_currents_that_rise_as_resistance_and_inductance_say) {
  MotorSetup setup = setup_of(test::small_motor(), "wave", 12, Regulation::resistive);
  setup.load.inertia = {1e3};  // the rotor stands still
  RunningMotor motor(setup);
  EXPECT_DOUBLE_EQ(motor.current_a().value, 1.7);
  motor.step(1);
  const double time_constant = 2.8e-3 / (12 / 1.7);
  double time = 0;
  for (const double until : {0.1e-3, 0.37e-3, 1e-3, 5e-3}) {
    motor.run(Seconds(until - time));
    time = until;
    EXPECT_NEAR(motor.current_b().value, 1.7 * (1 - std::exp(-time / time_constant)), 1.7 * 2e-4) << time;
  }
  EXPECT_EQ(motor.current_a().value, 0);  // went back into the supply
}

// The ringing after a microstep: a pendulum with √(N·T/J).
TEST(RunningMotor, rings_with_the_small_signal_resonance) {
  for (const MotorData& data : {test::small_motor(), test::large_motor()}) {
    const MotorSetup setup = setup_of(data, "microsteps:64");
    RunningMotor motor(setup);
    motor.step(1);
    const double step = 2e-6;
    double first = 0;
    double last = 0;
    int periods = -1;
    double before = motor.place() - 1;
    for (int i = 1; i <= 40'000; ++i) {
      motor.run(Seconds(step));
      const double now = motor.place() - 1;
      if (before < 0 && now >= 0) {
        last = step * (i - now / (now - before));
        if (++periods == 0) first = last;
      }
      before = now;
    }
    ASSERT_GT(periods, 5);
    const double torque = data.holding_torque.value / sqrt2;  // of sines
    const double expected = std::sqrt(data.rotor.teeth() * torque / data.rotor.inertia.value) / (2 * pi);
    EXPECT_NEAR(periods / (last - first), expected, 2e-3 * expected);
  }
}

// Nothing takes energy from a rotor whose currents are held: neither may the method, nor give any.
TEST(RunningMotor, keeps_the_energy_of_a_ringing_without_losses) {
  MotorSetup setup = setup_of(test::small_motor(), "two-on", 1e5);
  RunningMotor motor(setup);
  motor.step(1);
  const auto swing = [&] {
    double most = 0;
    for (int i = 0; i < 4000; ++i) {
      motor.run(Seconds(5e-6));
      most = std::max(most, std::abs(motor.lag()));
    }
    return most;
  };
  const double at_first = swing();
  motor.run(Seconds(5));
  EXPECT_NEAR(at_first, 1, 0.01);
  EXPECT_NEAR(swing(), at_first, 1e-3);
}

TEST(RunningMotor, holds_up_to_the_holding_torque) {
  for (const auto& [name, share] : {std::pair{"two-on", 1.0}, {"wave", 1 / sqrt2}, {"microsteps:8", 1 / sqrt2}}) {
    for (const double part : {0.97, -0.97, 1.03, -1.03}) {
      MotorSetup setup = setup_of(test::large_motor(), name);
      setup.weight = {part * share * 1.9};
      setup.damping = damping_of(setup.motor, 2);
      RunningMotor motor(setup);
      motor.run(Seconds(1));
      EXPECT_EQ(motor.slipped() != 0, std::abs(part) > 1) << name << " " << part;
      if (std::abs(part) < 1) {
        EXPECT_NEAR(std::sin(motor.lag() * pi / 2), part, 0.01);
      }
    }
  }
}

TEST(RunningMotor, stays_where_friction_holds_it_and_then_rests_for_nothing) {
  MotorSetup setup = setup_of(test::small_motor(), "microsteps:16");
  setup.load.friction = {0.1};
  RunningMotor motor(setup);
  EXPECT_TRUE(motor.rests());
  motor.step(1);
  EXPECT_FALSE(motor.rests());
  motor.run(Seconds(0.1));
  EXPECT_TRUE(motor.rests());
  EXPECT_EQ(motor.place(), 0);  // one microstep makes 0.03 N·m
  for (int i = 0; i < 15; ++i) motor.step(1);
  motor.run(Seconds(0.5));
  EXPECT_TRUE(motor.rests());
  EXPECT_LE(std::sin(motor.lag() * pi / 2) * 0.45 / sqrt2, 0.1 + 1e-9);
  EXPECT_EQ(motor.slipped(), 0);
}

// The whole torque at which a motor at that rate falls out of step: that of the trial, and its own damping.
double pull_out_by_trial(MotorSetup setup, double rate) {
  setup.damping = damping_of(setup.motor, 0.015);
  const double speed = rate * 2 * pi / setup.motor.rotor.steps_per_revolution;
  return tried_pull_out(setup, Hertz(rate)).value + setup.damping.value * speed;
}

TEST(RunningMotor, falls_out_of_step_where_the_textbook_says) {
  for (const MotorData& data : {test::small_motor(), test::large_motor()}) {
    for (const Regulation regulation : {Regulation::chopper, Regulation::resistive}) {
      for (const double rate : {300.0, 800.0, 1500.0}) {
        const MotorSetup setup = test::on_the_bench(data, "microsteps:8", 0.015, regulation);
        const auto curve = TorqueCurve::from_motor(setup.motor, setup.drive);
        ASSERT_TRUE(curve);
        const double expected = curve->pull_out(curve->speed_at(Hertz(rate))).value;
        const double found = pull_out_by_trial(setup, rate);
        // A chopper at its limit switches the whole supply to each phase. The textbook's sines have less.
        EXPECT_GT(found, 0.97 * expected) << rate;
        EXPECT_LT(found, (regulation == Regulation::chopper ? 1.06 : 1.03) * expected) << rate;
      }
    }
  }
}

TEST(RunningMotor, follows_a_measured_curve) {
  const auto curve = TorqueCurve::from_points(test::small_motor().rotor, {{Hertz(0), {0.4}}, {Hertz(2000), {0.1}}});
  MotorSetup setup = measured_setup(*curve, *Excitation::named("microsteps:8"));
  setup.load.inertia = setup.motor.rotor.inertia;
  for (const double rate : {300.0, 1000.0, 1500.0}) {
    const double expected = curve->pull_out(curve->speed_at(Hertz(rate))).value;
    EXPECT_NEAR(pull_out_by_trial(setup, rate), expected, 0.03 * expected) << rate;
  }
}

// A rotor that a hand carries is, when the hand lets go, where a rotor is that has got there by itself.
TEST(RunningMotor, goes_on_in_step_from_mid_motion) {
  MotorSetup setup = test::on_the_bench(test::small_motor(), "microsteps:8", 0.02);
  setup.load.friction = {0.05};
  const double rate = 800 * 8;
  const RadiansPerSecond speed{800 * 2 * pi / 200};
  const auto lags_after = [&](RunningMotor& motor, double time) {
    double least = 100;
    double most = -100;
    for (; time > 0; time -= 1 / rate) {
      motor.step(1);
      motor.run(Seconds(1 / rate));
      least = std::min(least, motor.lag());
      most = std::max(most, motor.lag());
    }
    return std::pair(least, most);
  };
  RunningMotor slow(setup);
  for (double at = 100; at < rate; at += 6'000 / at) {
    slow.step(1);
    slow.run(Seconds(1 / at));
  }
  lags_after(slow, 1);
  const auto [low, high] = lags_after(slow, 0.02);

  RunningMotor carried(setup);
  carried.carry(speed);
  lags_after(carried, 0.012);
  carried.let_go();
  const auto [least, most] = lags_after(carried, 0.05);
  EXPECT_NEAR(least, low, 0.05);
  EXPECT_NEAR(most, high, 0.05);
  EXPECT_EQ(carried.slipped(), 0);
}

TEST(RunningMotor, loses_whole_periods_of_its_teeth_in_too_steep_a_ramp) {
  MotorSetup setup = setup_of(test::small_motor(), "half-step");
  setup.damping = damping_of(setup.motor);
  setup.load.friction = {0.02};
  RunningMotor motor(setup);
  double rate = 200;
  for (int i = 0; i < 4000; ++i) {
    motor.step(1);
    motor.run(Seconds(1 / rate));
    rate += 200'000 / rate;
  }
  motor.run(Seconds(0.5));
  EXPECT_GT(motor.slipped(), 0);
  EXPECT_EQ(motor.slipped() % 8, 0);
  EXPECT_NEAR(motor.place() + static_cast<double>(motor.slipped()), 4000, 0.5);
}

// The same equations by the classic method of Runge and Kutta with a twentieth of the step. Voltages are given, as a
// resistive drive gives them.
struct Reference {
  MotorSetup setup;
  double a, b, angle, speed = 0;

  explicit Reference(const MotorSetup& what) : setup(what) {
    const WindingState state = setup.excitation.at(0);
    a = state.phase_a * setup.motor.rated_current.value;
    b = state.phase_b * setup.motor.rated_current.value;
    angle = std::atan2(b, a);
  }
  struct Rates {
    double a, b, angle, speed;
  };
  Rates rates(const Rates& at, const WindingState& state) const {
    const MotorData& motor = setup.motor;
    const double k = motor.holding_torque.value / sqrt2 / motor.rated_current.value;
    const double supply = setup.drive.supply.value;
    const double r = supply / motor.rated_current.value;
    const double l = motor.inductance.value;
    const double inertia = motor.rotor.inertia.value + setup.load.inertia.value;
    const double torque = k * (at.b * std::cos(at.angle) - at.a * std::sin(at.angle)) -
                          setup.detent.value * std::sin(4 * at.angle) - setup.weight.value;
    return {(state.phase_a * supply - r * at.a + k * at.speed * std::sin(at.angle)) / l,
            (state.phase_b * supply - r * at.b - k * at.speed * std::cos(at.angle)) / l, motor.rotor.teeth() * at.speed,
            (torque - setup.damping.value * at.speed) / inertia};
  }
  void run(double time, std::int64_t place) {
    const WindingState state = setup.excitation.at(place);
    const int count = static_cast<int>(std::ceil(time / 1e-6));
    const double h = time / count;
    const auto moved = [](const Rates& from, const Rates& rate, double by) {
      return Rates{from.a + by * rate.a, from.b + by * rate.b, from.angle + by * rate.angle,
                   from.speed + by * rate.speed};
    };
    for (int i = 0; i < count; ++i) {
      const Rates now{a, b, angle, speed};
      const Rates k1 = rates(now, state);
      const Rates k2 = rates(moved(now, k1, h / 2), state);
      const Rates k3 = rates(moved(now, k2, h / 2), state);
      const Rates k4 = rates(moved(now, k3, h), state);
      a += h / 6 * (k1.a + 2 * k2.a + 2 * k3.a + k4.a);
      b += h / 6 * (k1.b + 2 * k2.b + 2 * k3.b + k4.b);
      angle += h / 6 * (k1.angle + 2 * k2.angle + 2 * k3.angle + k4.angle);
      speed += h / 6 * (k1.speed + 2 * k2.speed + 2 * k3.speed + k4.speed);
    }
  }
};

TEST(RunningMotor, goes_as_its_equations_integrated_by_another_method) {
  std::mt19937_64 random(test::seed());
  double worst = 0;
  for (int trial = 0; trial < 12; ++trial) {
    test::Driven driven = test::random_motor(random);
    driven.drive.regulation = Regulation::resistive;
    MotorSetup setup{.motor = driven.motor, .drive = driven.drive, .excitation = *Excitation::named("microsteps:4")};
    setup.detent = {0.03 * driven.motor.holding_torque.value};
    setup.weight = {0.1 * driven.motor.holding_torque.value};
    setup.damping = damping_of(setup.motor);
    setup.load.inertia = driven.motor.rotor.inertia;
    RunningMotor motor(setup);
    Reference reference(setup);
    const double resonance = std::sqrt(driven.motor.rotor.teeth() * driven.motor.holding_torque.value /
                                       (2 * driven.motor.rotor.inertia.value)) /
                             (2 * pi);
    for (std::int64_t place = 1; place <= 60; ++place) {
      const double time = 1 / (resonance * (0.3 + 0.05 * static_cast<double>(place)));
      motor.step(1);
      motor.run(Seconds(time));
      reference.run(time, place);
      const double there = (reference.angle - std::atan2(1, 1)) * 8 / pi;
      if (motor.slipped() != 0) break;
      worst = std::max(worst, std::abs(motor.place() - there));
    }
  }
  RecordProperty("worst_difference_in_microsteps", std::to_string(worst));
  EXPECT_LT(worst, 0.02);
}

}  // namespace
}  // namespace passo
