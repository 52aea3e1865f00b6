#include "passo/motor/motor_data.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace passo {
namespace {

struct Quantified {
  const char* name;
  double value;
  const char* unit;
};

Status<MotorError> check_positive(std::initializer_list<Quantified> all) {
  for (const Quantified& one : all) {
    if (std::isfinite(one.value) && one.value > 0) continue;
    return Failure{MotorError{fmt::format("{} must be above 0 {}, not {:g}", one.name, one.unit, one.value)}};
  }
  return Unit{};
}

}  // namespace

Status<MotorError> check(const Rotor& rotor) {
  if (rotor.steps_per_revolution < 4 || rotor.steps_per_revolution % 4 != 0) {
    return Failure{
        MotorError{fmt::format("the full steps per revolution of a two-phase motor must be a multiple of 4, not {}",
                               rotor.steps_per_revolution)}};
  }
  return check_positive({{"the rotor's inertia", rotor.inertia.value, "kg\u00B7m\u00B2"}});
}

Status<MotorError> check(const MotorData& data) {
  Status<MotorError> rotor = check(data.rotor);
  if (!rotor) return rotor;
  return check_positive({{"the holding torque", data.holding_torque.value, "N\u00B7m"},
                         {"the rated current", data.rated_current.value, "A"},
                         {"the resistance", data.resistance.value, "ohm"},
                         {"the inductance", data.inductance.value, "H"}});
}

Status<MotorError> check(const MotorDrive& drive) {
  Status<MotorError> supply =
      check_positive({{"the supply voltage", drive.supply.value, "V"},
                      {"the supply voltage minus the drop", drive.supply.value - drive.drop.value, "V"}});
  if (!supply) return supply;
  if (drive.drop.value >= 0 && drive.fast_decay >= 0 && drive.fast_decay <= 1) return Unit{};
  return Failure{MotorError{fmt::format("the drop must be 0 V or more, not {:g}, and the decay from 0 to 1, not {:g}",
                                        drive.drop.value, drive.fast_decay)}};
}

MotorData as_wound(const MotorData& data, Winding winding) {
  if (data.winding == winding) return data;
  const double turns = winding == Winding::half_coil ? 0.5 : 2.0;
  const double root = std::sqrt(turns);
  MotorData other = data;
  other.winding = winding;
  other.resistance.value *= turns;
  other.inductance.value *= turns * turns;
  other.rated_current.value /= root;
  other.holding_torque.value *= root;  // (torque per ampere) × turns, × current / √turns
  return other;
}

}  // namespace passo
