#include "torque_reader.hpp"

#include <numbers>
#include <utility>

#include "machine_file_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr double kg_m2_per_g_cm2 = 1e-7;
constexpr double metres_per_mm = 1e-3;
constexpr double henries_per_millihenry = 1e-3;

constexpr NumberKey full_steps_key{"full_steps_per_turn", 4, 4000, "200"};
constexpr NumberKey pull_out_key{"pull_out_steps_s_nm", 0, 1e7, "[[0, 1.2], [1000, 0.9], [4000, 0.2]]"};
constexpr NumberKey holding_key{"holding_torque_nm", 1e-5, 1e4, "1.9"};
constexpr NumberKey current_key{"rated_current_a", 1e-3, 1e3, "2.8"};
constexpr NumberKey resistance_key{"resistance_ohm", 1e-4, 1e5, "1.13"};
constexpr NumberKey inductance_key{"inductance_mh", 1e-4, 1e5, "3.6"};
constexpr NumberKey supply_key{"supply_v", 0.1, 1e4, "36"};
constexpr const NumberKey* electrical_keys[] = {&holding_key, &current_key, &resistance_key, &inductance_key,
                                                &supply_key};

constexpr NumberKey rotor_key{"rotor_inertia_g_cm2", 1e-3, 1e8, "480"};
constexpr NumberKey inertia_key{"load_inertia_g_cm2", 0, 1e9, "150"};
constexpr NumberKey mass_key{"load_mass_kg", 0, 1e5, "12"};
constexpr NumberKey shaft_friction_key{"friction_nm", 0, 1e4, "0.05"};
constexpr NumberKey slide_friction_key{"friction_n", 0, 1e6, "20"};
constexpr NumberKey drop_key{"transistor_drop_v", 0, 100, "1.2"};
constexpr NumberKey decay_key{"fast_decay_share", 0, 1, "0.5"};
constexpr NumberKey detent_key{"detent_torque_nm", 0, 1e4, "0.02"};
constexpr NumberKey weight_key{"weight_n", -1e6, 1e6, "30"};
constexpr NumberKey share_key{"share_of_pull_out", 0.05, 1, "0.7"};
constexpr NumberKey tolerance_key{"tolerance", 0, 0.5, "0.15"};

const char* const torque_code = "machine.torque";

std::optional<TorqueCurve> from(TableReader& reader, std::string_view key, Result<TorqueCurve, MotorError> curve) {
  if (curve) return std::move(*curve);
  reader.error(torque_code, key, curve.error().message, "values from the motor's data sheet");
  return std::nullopt;
}

std::optional<TorqueCurve> read_points(TableReader& reader, const Rotor& rotor) {
  reader.know(pull_out_key.name);
  for (const NumberKey* key : electrical_keys) reader.know(key->name);
  for (const NumberKey* key : {&drop_key, &decay_key}) reader.know(key->name);
  for (const NumberKey* key : electrical_keys) {
    if (!reader.has(key->name)) continue;
    reader.error(torque_code, key->name,
                 machine_file_says::both_given.with(
                     {{"first", reader.full_name(key->name)}, {"second", std::string(pull_out_key.name)}}),
                 fmt::format("either measured torque, {}, or the motor's data", pull_out_key.name));
    return std::nullopt;
  }
  const auto pairs = reader.pairs(pull_out_key);
  if (!pairs) return std::nullopt;
  std::vector<TorquePoint> points;
  for (const auto& [rate, torque] : *pairs) points.push_back({Hertz(rate), {torque}});
  return from(reader, pull_out_key.name, TorqueCurve::from_points(rotor, points));
}

std::optional<TorqueCurve> read_motor(TableReader& reader, const Rotor& rotor, std::optional<DrivenMotor>& driven) {
  const auto holding = reader.number(holding_key, Need::required);
  const auto current = reader.number(current_key, Need::required);
  const auto resistance = reader.number(resistance_key, Need::required);
  const auto inductance = reader.number(inductance_key, Need::required);
  const auto supply = reader.number(supply_key, Need::required);
  const auto unipolar = reader.is_second_of(torque_code, "winding", "bipolar", "unipolar", Need::optional);
  const auto resistive = reader.is_second_of(torque_code, "drive", "chopper", "resistive", Need::optional);
  const auto drop = reader.number(drop_key, Need::optional);
  const auto decay = reader.number(decay_key, Need::optional);
  if (!holding || !current || !resistance || !inductance || !supply || !unipolar || !resistive) return std::nullopt;
  const Winding winding = *unipolar ? Winding::half_coil : Winding::whole_coil;
  driven = DrivenMotor{.data = {.rotor = rotor,
                                .holding_torque = {*holding},
                                .rated_current = {*current},
                                .resistance = {*resistance},
                                .inductance = {*inductance * henries_per_millihenry},
                                .winding = winding},
                       .drive = {.supply = {*supply},
                                 .winding = winding,
                                 .regulation = *resistive ? Regulation::resistive : Regulation::chopper,
                                 .drop = {drop.value_or(0)},
                                 .fast_decay = decay.value_or(1)}};
  return from(reader, holding_key.name, TorqueCurve::from_motor(driven->data, driven->drive));
}

}  // namespace

std::optional<AxisMotor> read_torque(TableReader& reader, bool rotary, std::optional<double> unit_per_turn) {
  const auto full_steps = reader.whole_number(full_steps_key, Need::optional);
  const auto rotor_inertia = reader.number(rotor_key, Need::required);
  const Rotor rotor{.steps_per_revolution = static_cast<int>(full_steps.value_or(200)),
                    .inertia = {rotor_inertia.value_or(1) * kg_m2_per_g_cm2}};
  const bool measured = reader.has(pull_out_key.name);
  std::optional<DrivenMotor> driven;
  auto curve = measured ? read_points(reader, rotor) : read_motor(reader, rotor, driven);
  if (!measured) reader.know(pull_out_key.name);

  const double radians_per_unit = 2 * std::numbers::pi / unit_per_turn.value_or(1);
  Load load;
  load.inertia.value = reader.number(inertia_key, Need::optional).value_or(0) * kg_m2_per_g_cm2;
  load.friction.value = reader.number(shaft_friction_key, Need::optional).value_or(0);
  if (!rotary) {
    const double way = metres_per_mm / radians_per_unit;  // for each radian of the shaft
    load.inertia.value += reader.number(mass_key, Need::optional).value_or(0) * way * way;
    load.friction.value += reader.number(slide_friction_key, Need::optional).value_or(0) * way;
  }
  const auto detent = reader.number(detent_key, Need::optional);
  NewtonMetres weight;
  if (!rotary) weight.value = reader.number(weight_key, Need::optional).value_or(0) * metres_per_mm / radians_per_unit;
  const auto share = reader.number(share_key, Need::optional);
  const auto tolerance = reader.number(tolerance_key, Need::optional);
  const auto limits_motion = reader.flag("limits_motion");
  if (!curve || !rotor_inertia || !unit_per_turn) return std::nullopt;
  return AxisMotor{.curve = std::move(*curve),
                   .load = load,
                   .share = share.value_or(0.7),
                   .tolerance = tolerance.value_or(usual_tolerance),
                   .limits_motion = limits_motion.value_or(true),
                   .radians_per_unit = radians_per_unit,
                   .driven = driven,
                   .detent = {detent.value_or(0)},
                   .weight = weight};
}

}  // namespace passo
