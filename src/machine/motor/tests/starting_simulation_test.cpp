// The computed starting speed compared with a whole simulated motor: both coils, a chopper that clips at the supply,
// and the rotor with its load and friction. The pulses begin at their full rate. The motor has followed if it is never
// more behind than half a period of its torque, two steps, and a little.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "example_motors.hpp"

#include "passo/motor/torque_curve.hpp"

namespace passo {
namespace {

using std::numbers::pi;

enum class Pulses : std::uint8_t { fine, whole_steps };

struct State {
  double current_a = 0;
  double current_b = 0;
  double angle = 0;
  double speed = 0;
};

class SimulatedMotor {
 public:
  SimulatedMotor(const MotorData& motor, double supply, const Load& load)
      : resistance_(motor.resistance.value),
        inductance_(motor.inductance.value),
        current_(motor.rated_current.value),
        torque_constant_(motor.holding_torque.value / std::sqrt(2.0) / current_),
        inertia_(motor.rotor.inertia.value + load.inertia.value),
        friction_(load.friction.value),
        supply_(supply) {}

  bool starts(double rate, Pulses pulses) const {
    const double gain = 50 * supply_ / current_;
    const double h = 0.5 * inductance_ / gain;
    State state{.current_a = current_};
    for (double t = 0; t < 0.15; t += h) {
      const double field = pi / 2 * (pulses == Pulses::fine ? rate * t : std::floor(rate * t) + 1);
      const State first = change(state, field, gain);
      const State middle{state.current_a + h / 2 * first.current_a, state.current_b + h / 2 * first.current_b,
                         state.angle + h / 2 * first.angle, state.speed + h / 2 * first.speed};
      const State second = change(middle, field, gain);
      const double speed = state.speed + h * second.speed;
      // Dry friction brings the rotor to rest but does not turn it back.
      state = {state.current_a + h * second.current_a, state.current_b + h * second.current_b,
               state.angle + h * second.angle, state.speed * speed < 0 ? 0 : speed};
      if (pi / 2 * rate * t - teeth * state.angle > 2 * pi) return false;
    }
    return true;
  }

 private:
  static constexpr double teeth = 50;

  State change(const State& state, double field, double gain) const {
    const double sine = std::sin(teeth * state.angle);
    const double cosine = std::cos(teeth * state.angle);
    const double voltage_a = std::clamp(gain * (current_ * std::cos(field) - state.current_a), -supply_, supply_);
    const double voltage_b = std::clamp(gain * (current_ * std::sin(field) - state.current_b), -supply_, supply_);
    const double back_emf = torque_constant_ * state.speed;
    const double torque = torque_constant_ * (state.current_b * cosine - state.current_a * sine);
    const double drag =
        state.speed != 0 ? std::copysign(friction_, state.speed) : std::clamp(torque, -friction_, friction_);
    return {.current_a = (voltage_a - resistance_ * state.current_a + back_emf * sine) / inductance_,
            .current_b = (voltage_b - resistance_ * state.current_b - back_emf * cosine) / inductance_,
            .angle = state.speed,
            .speed = (torque - drag) / inertia_};
  }

  double resistance_;
  double inductance_;
  double current_;
  double torque_constant_;
  double inertia_;
  double friction_;
  double supply_;
};

TEST(StartingSimulation, a_whole_motor_starts_about_as_fast_as_computed_and_a_fifth_slower_in_whole_steps) {
  const MotorData motor = test::small_motor();
  for (const double supply : {12.0, 36.0}) {
    const TorqueCurve curve = *TorqueCurve::from_motor(motor, {.supply = {supply}});
    for (const Load& load :
         {Load{}, Load{.inertia = {6.8e-6}, .friction = {0.05}}, Load{.inertia = {20e-6}}, Load{.friction = {0.15}}}) {
      const SimulatedMotor simulated(motor, supply, load);
      const double computed = curve.rate_at(curve.maximum_starting_speed(load)).value();
      EXPECT_TRUE(simulated.starts(0.95 * computed, Pulses::fine)) << supply << " V, " << computed << " steps/s";
      EXPECT_FALSE(simulated.starts(1.15 * computed, Pulses::fine)) << supply << " V, " << computed << " steps/s";
      EXPECT_TRUE(simulated.starts(0.8 * computed, Pulses::whole_steps)) << supply << " V, " << computed << " steps/s";
    }
  }
}

}  // namespace
}  // namespace passo
