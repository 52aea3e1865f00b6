#include "passo/motor/torque_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

// No rotor survives a million radians a second. Where the model still has torque there, it has no end.
constexpr double beyond_any_motor = 1e6;

// `holds` is true up to some speed and false beyond. Returns that speed to the last bit, or nothing if `holds` never
// ends.
template <class Holds>
std::optional<double> end_of(const Holds& holds) {
  if (!holds(0.0)) return 0.0;
  double low = 0;
  double high = 1;
  for (; holds(high); high *= 2) {
    if (high > beyond_any_motor) return std::nullopt;
    low = high;
  }
  for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2) {
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

// The share cos β of the torque that friction may take, where `energy` (in units of torque a tooth) must be left to
// catch the rotor. Solves energy = 2·(sin β − β·cos β), which rises from 0 to 2 while β goes from 0 to a quarter turn.
double friction_share_for(double energy) {
  double low = 0;
  double high = std::numbers::pi / 2;
  for (double middle = high / 2; middle > low && middle < high; middle = (low + high) / 2) {
    (2 * (std::sin(middle) - middle * std::cos(middle)) < energy ? low : high) = middle;
  }
  return std::cos(low);
}

double up_to_the_last_point(const MonotoneCurve& curve, double x) {
  return x <= curve.last() ? curve.at(x) : 0.0;
}

Result<MonotoneCurve, MotorError> falling_curve(const char* name, const Rotor& rotor,
                                                const std::vector<TorquePoint>& points) {
  std::vector<CurvePoint> plain;
  for (const TorquePoint& point : points) {
    const double rate = point.rate.value();
    if (!(rate >= 0) || !(point.torque.value >= 0)) {
      return Failure{MotorError{
          fmt::format("{}: rate and torque cannot be negative, but {:g}:{:g} is", name, rate, point.torque.value)}};
    }
    if (!plain.empty() && point.torque.value > plain.back().y) {
      return Failure{
          MotorError{fmt::format("{}: torque must fall with the rate, but rises to {:g} N\u00B7m at {:g} steps/s", name,
                                 point.torque.value, rate)}};
    }
    plain.push_back({rate * 2 * std::numbers::pi / rotor.steps_per_revolution, point.torque.value});
  }
  Result<MonotoneCurve, CurvePointsError> curve = MonotoneCurve::through(std::move(plain));
  if (!curve) return Failure{MotorError{fmt::format("{}: {}", name, curve.error().message)}};
  if (!(curve->points().front().y > 0)) {
    return Failure{MotorError{fmt::format("{}: the torque of all points is 0", name)}};
  }
  return std::move(*curve);
}

}  // namespace

Status<MotorError> check(const Load& load) {
  const auto good = [](double value) { return std::isfinite(value) && value >= 0; };
  if (!good(load.inertia.value)) {
    return Failure{
        MotorError{fmt::format("the load's inertia must be 0 kg\u00B7m\u00B2 or more, not {:g}", load.inertia.value)}};
  }
  if (!good(load.friction.value)) {
    return Failure{MotorError{fmt::format("friction must be 0 N\u00B7m or more, not {:g}", load.friction.value)}};
  }
  if (!good(load.friction_per_speed.value)) {
    return Failure{MotorError{fmt::format("viscous friction must be 0 N\u00B7m\u00B7s/rad or more, not {:g}",
                                          load.friction_per_speed.value)}};
  }
  return Unit{};
}

Result<TorqueCurve, MotorError> TorqueCurve::from_points(const Rotor& rotor, const std::vector<TorquePoint>& pull_out,
                                                         const std::vector<TorquePoint>& pull_in) {
  const Status<MotorError> good = check(rotor);
  if (!good) return Failure{good.error()};
  Result<MonotoneCurve, MotorError> outer = falling_curve("pull-out", rotor, pull_out);
  if (!outer) return Failure{outer.error()};
  TorqueCurve curve(rotor, std::move(*outer));
  if (pull_in.empty()) return curve;

  Result<MonotoneCurve, MotorError> inner = falling_curve("pull-in", rotor, pull_in);
  if (!inner) return Failure{inner.error()};
  for (const TorquePoint& point : pull_in) {
    if (point.torque <= curve.pull_out(curve.speed_at(point.rate))) continue;
    return Failure{MotorError{
        fmt::format("pull-in torque cannot be above pull-out torque, as at {:g} steps/s", point.rate.value())}};
  }
  curve.pull_in_ = std::move(*inner);
  return curve;
}

Result<TorqueCurve, MotorError> TorqueCurve::from_motor(const MotorData& data, const MotorDrive& drive) {
  const Status<MotorError> good_data = check(data);
  if (!good_data) return Failure{good_data.error()};
  const Status<MotorError> good_drive = check(drive);
  if (!good_drive) return Failure{good_drive.error()};
  return TorqueCurve(data.rotor, DrivenWinding(data, drive));
}

TorqueCurve TorqueCurve::scaled(double factor) const {
  TorqueCurve scaled = *this;
  scaled.factor_ *= factor;
  return scaled;
}

RadiansPerSecond TorqueCurve::speed_at(Hertz rate) const {
  return {rate.value() * 2 * std::numbers::pi / rotor_.steps_per_revolution};
}

Hertz TorqueCurve::rate_at(RadiansPerSecond speed) const {
  return Hertz(speed.value * rotor_.steps_per_revolution / (2 * std::numbers::pi));
}

NewtonMetres TorqueCurve::pull_out(RadiansPerSecond speed) const {
  if (const auto* winding = std::get_if<DrivenWinding>(&pull_out_)) return {factor_ * winding->pull_out(speed).value};
  return {factor_ * up_to_the_last_point(std::get<MonotoneCurve>(pull_out_), speed.value)};
}

NewtonMetres TorqueCurve::pull_in(RadiansPerSecond speed, KilogramMetres2 load_inertia) const {
  const double inertia = rotor_.inertia.value + load_inertia.value;
  if (!pull_in_) return {computed_pull_in(speed.value, inertia)};
  // At the same energy and torque the rotor alone would start faster by this factor.
  const double alone = speed.value * std::sqrt(inertia / rotor_.inertia.value);
  return std::min(NewtonMetres{factor_ * up_to_the_last_point(*pull_in_, alone)}, pull_out(speed));
}

double TorqueCurve::computed_pull_in(double speed, double inertia) const {
  const double torque = pull_out({speed}).value;
  if (!(torque > 0)) return 0;
  const double energy = inertia * speed * speed / 2 * rotor_.teeth() / torque;
  return energy < 2 ? torque * friction_share_for(energy) : 0;
}

RadiansPerSecond TorqueCurve::maximum_starting_speed(const Load& load) const {
  const auto starts = [&](double speed) { return pull_in({speed}, load.inertia) > load.friction_at({speed}); };
  // Inertia always makes an end.
  return {end_of(starts).value_or(beyond_any_motor)};
}

std::optional<RadiansPerSecond> TorqueCurve::fastest_speed(const Load& load) const {
  const auto drives = [&](double speed) { return pull_out({speed}) > load.friction_at({speed}); };
  const std::optional<double> end = end_of(drives);
  return end ? std::optional(RadiansPerSecond{*end}) : std::nullopt;
}

RadiansPerSecond2 TorqueCurve::available_acceleration(RadiansPerSecond speed, const Load& load, double margin) const {
  const double torque = pull_out(speed).value - load.friction_at(speed).value;
  return {margin * std::max(torque, 0.0) / (rotor_.inertia.value + load.inertia.value)};
}

Hertz natural_end(const TorqueCurve& curve, const Load& load) {
  const double standstill = curve.pull_out({0}).value;
  std::optional<RadiansPerSecond> end = curve.fastest_speed(load);
  const std::optional<RadiansPerSecond> weak = curve.fastest_speed({.friction = {standstill / 20}});
  if (!end || end->value == 0 || (weak && *weak < *end)) end = weak;
  return Hertz(1.06 * curve.rate_at(end.value_or(RadiansPerSecond{1000})).value());
}

}  // namespace passo
