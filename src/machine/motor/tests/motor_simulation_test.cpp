// The closed form compared with the motor itself: its differential equations, integrated.
//
// Two phases, each with R·i + L·di/dt + e = v, and a rotor turned at constant speed. The drive's voltage or current
// vector turns with the rotor, at the angle that a search finds best for the torque. Nothing here comes from the model:
// voltages are made in the frame of the coils, the current is measured, and the torque is averaged over periods.
#include <cmath>
#include <numbers>
#include <random>

#include "example_motors.hpp"
#include "kit/seed.hpp"

#include "passo/motor/driven_winding.hpp"

namespace passo {
namespace {

using std::numbers::pi;

struct Pair {  // of phase a and phase b
  double a = 0;
  double b = 0;
};
Pair operator+(Pair x, Pair y) {
  return {x.a + y.a, x.b + y.b};
}
Pair operator*(double k, Pair x) {
  return {k * x.a, k * x.b};
}
double length(Pair x) {
  return std::hypot(x.a, x.b);
}

struct Coils {
  double resistance = 0;
  double inductance = 0;
  double torque_constant = 0;
  double frequency = 0;  // electrical, rad/s
  double speed = 0;      // of the rotor, rad/s
};

// The mean torque in the steady state. `source(angle, current)` returns the drive's voltages for the drive's angle and
// the present currents. The drive is ahead of the rotor's back-EMF by `lead`.
template <class Source>
double mean_torque(const Coils& coils, const Source& source, double lead, double fastest_change) {
  const double period = 2 * pi / coils.frequency;
  const double step_limit = std::min(period / 48, 1.2 * fastest_change);
  const int steps = static_cast<int>(std::ceil(period / step_limit));
  const double h = period / steps;
  const auto change = [&](double t, Pair current) {
    const double angle = coils.frequency * t;
    const double emf = coils.torque_constant * coils.speed;
    const Pair voltage = source(angle + lead, current);
    return Pair{(voltage.a - coils.resistance * current.a + emf * std::sin(angle)) / coils.inductance,
                (voltage.b - coils.resistance * current.b - emf * std::cos(angle)) / coils.inductance};
  };
  Pair current;
  double last = 0;
  for (int count = 0; count < 2000; ++count) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      sum += -current.a * std::sin(coils.frequency * t) + current.b * std::cos(coils.frequency * t);
      const Pair k1 = change(t, current);
      const Pair k2 = change(t + h / 2, current + h / 2 * k1);
      const Pair k3 = change(t + h / 2, current + h / 2 * k2);
      const Pair k4 = change(t + h, current + h * k3);
      current = current + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    const double torque = coils.torque_constant * sum / steps;
    if (count > 2 && std::abs(torque - last) < 2e-5 * coils.torque_constant) return torque;
    last = torque;
  }
  ADD_FAILURE() << "the simulation does not settle";
  return last;
}

// The greatest torque over all angles: a coarse search, then a finer one.
template <class Torque>
double most_torque(const Torque& torque) {
  double best = 0;
  double most = torque(0);
  double width = pi / 8;
  for (double angle = -pi + width; angle < pi; angle += width) {
    const double here = torque(angle);
    if (here > most) {
      most = here;
      best = angle;
    }
  }
  for (; width > 0.02; width /= 2) {
    for (const double angle : {best - width / 2, best + width / 2}) {
      const double here = torque(angle);
      if (here > most) {
        most = here;
        best = angle;
      }
    }
  }
  return most;
}

// The parts of the two drives, computed here from the sheet and not by the model.
struct Bench {
  explicit Bench(const test::Driven& driven)
      : current(driven.motor.rated_current.value),
        supply(driven.drive.supply.value),
        teeth(driven.motor.rotor.steps_per_revolution / 4),
        coils{.resistance = driven.motor.resistance.value,
              .inductance = driven.motor.inductance.value,
              .torque_constant = driven.motor.holding_torque.value / std::sqrt(2.0) / current} {}

  Coils at(double speed) const {
    Coils turning = coils;
    turning.speed = speed;
    turning.frequency = speed * teeth;
    return turning;
  }

  // A sine voltage through a series resistor.
  double resistive(double speed) const {
    Coils turning = at(speed);
    turning.resistance = supply / current;
    const auto source = [this](double angle, Pair) {
      return Pair{-supply * std::sin(angle), supply * std::cos(angle)};
    };
    return most_torque(
        [&](double lead) { return mean_torque(turning, source, lead, turning.inductance / turning.resistance); });
  }
  // Full steps: the supply is only switched, it does not turn.
  double resistive_full_steps(double speed) const {
    Coils turning = at(speed);
    turning.resistance = supply / current;
    const auto source = [this](double angle, Pair) {
      return Pair{std::sin(angle) < 0 ? supply : -supply, std::cos(angle) < 0 ? -supply : supply};
    };
    return most_torque(
        [&](double lead) { return mean_torque(turning, source, lead, turning.inductance / turning.resistance); });
  }
  // A regulator that follows sines of the rated current with no more than the supply: in the sum of both phases
  // (`together`) or in each.
  double chopper(double speed, bool together) const {
    const Coils turning = at(speed);
    const double gain = 100 * supply / current;
    const auto source = [this, gain, together](double angle, Pair flowing) {
      const Pair wanted{-current * std::sin(angle), current * std::cos(angle)};
      const Pair voltage = gain * (wanted + -1.0 * flowing);
      if (together) return std::min(1.0, supply / length(voltage)) * voltage;
      return Pair{std::clamp(voltage.a, -supply, supply), std::clamp(voltage.b, -supply, supply)};
    };
    return most_torque([&](double lead) { return mean_torque(turning, source, lead, turning.inductance / gain); });
  }

  double current;
  double supply;
  double teeth;
  Coils coils;
};

// Speeds around the one that uses up the supply, where the curve bends.
std::vector<double> speeds_of(const Bench& bench) {
  const double corner =
      bench.supply / (bench.teeth * bench.current * bench.coils.inductance + bench.coils.torque_constant);
  return {0.1 * corner, 0.5 * corner, 0.8 * corner, corner, 1.5 * corner, 3 * corner};
}

template <class Look>
void for_motors(int count, const Look& look) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  look(test::Driven{test::small_motor(), {.supply = {24}}});
  look(test::Driven{test::large_motor(), {.supply = {36}}});
  for (int i = 2; i < count; ++i) look(test::random_motor(random));
}

TEST(MotorSimulation, confirms_the_pull_out_of_the_resistive_drive_to_a_thousandth) {
  for_motors(12, [](test::Driven driven) {
    driven.drive.regulation = Regulation::resistive;
    const Bench bench(driven);
    const DrivenWinding winding(driven.motor, driven.drive);
    for (const double speed : speeds_of(bench)) {
      const double standstill = winding.pull_out({0}).value;
      EXPECT_NEAR(winding.pull_out({speed}).value, std::max(0.0, bench.resistive(speed)), 1e-3 * standstill) << speed;
    }
  });
}

TEST(MotorSimulation, confirms_the_pull_out_of_the_chopper_to_two_hundredths) {
  for_motors(4, [](const test::Driven& driven) {
    const Bench bench(driven);
    const DrivenWinding winding(driven.motor, driven.drive);
    for (const double speed : speeds_of(bench)) {
      const double standstill = winding.pull_out({0}).value;
      EXPECT_NEAR(winding.pull_out({speed}).value, std::max(0.0, bench.chopper(speed, true)), 2e-2 * standstill)
          << speed;
    }
  });
}

// What the model leaves out is on the safe side.
TEST(MotorSimulation, full_steps_give_a_quarter_more_than_the_curve) {
  for_motors(12, [](test::Driven driven) {
    driven.drive.regulation = Regulation::resistive;
    const Bench bench(driven);
    const DrivenWinding winding(driven.motor, driven.drive);
    for (const double speed : speeds_of(bench)) {
      const double torque = winding.pull_out({speed}).value;
      if (torque == 0) continue;
      EXPECT_GE(bench.resistive_full_steps(speed), 1.25 * torque) << speed;
    }
  });
}

TEST(MotorSimulation, a_chopper_that_clips_each_phase_on_its_own_gives_no_less_than_the_curve) {
  for_motors(4, [](const test::Driven& driven) {
    const Bench bench(driven);
    const DrivenWinding winding(driven.motor, driven.drive);
    for (const double speed : speeds_of(bench)) {
      const double standstill = winding.pull_out({0}).value;
      EXPECT_GE(std::max(0.0, bench.chopper(speed, false)), winding.pull_out({speed}).value - 2e-2 * standstill);
    }
  });
}

}  // namespace
}  // namespace passo
