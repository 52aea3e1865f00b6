#include <cmath>

#include "json_text.hpp"

#include "passo/lab/answers.hpp"

namespace passo {

std::string windings_answer(const Excitation& excitation, std::int32_t full_steps_per_turn, std::int64_t first,
                            std::int64_t last) {
  if (full_steps_per_turn < 1) return error_answer("expected at least one full step per revolution");
  if (last < first || last - first >= most_entries) {
    return error_answer(fmt::format("expected 1 to {} points", most_entries));
  }
  std::vector<std::int64_t> pattern;
  std::vector<double> a;
  std::vector<double> b;
  std::vector<double> degrees;
  for (std::int64_t place = first; place <= last; ++place) {
    const WindingState state = excitation.at(place);
    pattern.push_back(state.pattern);
    a.push_back(state.phase_a);
    b.push_back(state.phase_b);
    degrees.push_back(excitation.rotor_degrees(place, full_steps_per_turn));
  }
  JsonText json;
  json.number("first", static_cast<double>(first));
  json.number("steps_per_full_step", excitation.steps_per_full_step());
  json.list("pattern", pattern);
  json.list("phase_a", a);
  json.list("phase_b", b);
  json.list("degrees", degrees);
  return json.take();
}

std::string torque_answer(const TorqueQuestion& question) {
  for (const Status<MotorError>& good : {check(question.motor), check(question.drive), check(question.load)}) {
    if (!good) return error_answer(good.error().message);
  }
  if (!(question.margin > 0 && question.margin <= 1)) return error_answer("expected a margin above 0, up to 1");
  if (!(question.acceleration.value >= 0 && std::isfinite(question.acceleration.value))) {
    return error_answer("expected an acceleration of 0 rad/s² or more");
  }
  if (question.rows < 2 || question.rows > most_entries) return error_answer("expected at least 2 rows");
  const auto curve = TorqueCurve::from_motor(question.motor, question.drive);
  if (!curve) return error_answer(curve.error().message);
  const Hertz end = question.end > Hertz(0) ? question.end : natural_end(*curve, question.load);
  std::vector<double> rates;
  std::vector<double> pull_out;
  std::vector<double> pull_in;
  std::vector<double> friction;
  std::vector<double> needed;
  std::vector<double> acceleration;
  // What accelerates is felt as friction that is the same at any speed.
  Load accelerated = question.load;
  accelerated.friction.value +=
      (curve->rotor().inertia.value + question.load.inertia.value) * question.acceleration.value;
  for (std::int32_t i = 0; i < question.rows; ++i) {
    const Hertz rate(end.value() * i / (question.rows - 1));
    const RadiansPerSecond speed = curve->speed_at(rate);
    rates.push_back(rate.value());
    pull_out.push_back(curve->pull_out(speed).value);
    pull_in.push_back(curve->pull_in(speed, question.load.inertia).value);
    friction.push_back(question.load.friction_at(speed).value);
    needed.push_back(accelerated.friction_at(speed).value);
    acceleration.push_back(curve->available_acceleration(speed, question.load, question.margin).value);
  }
  JsonText json;
  json.list("rate_hz", rates);
  json.list("pull_out_nm", pull_out);
  json.list("pull_in_nm", pull_in);
  json.list("friction_nm", friction);
  json.list("needed_nm", needed);
  json.list("acceleration_rad_s2", acceleration);
  json.number("standstill_torque_nm", curve->pull_out({0}).value);
  json.number("starting_rate_hz", curve->rate_at(curve->maximum_starting_speed(question.load)).value());
  const auto rate_of = [&](const std::optional<RadiansPerSecond>& speed) {
    return speed ? std::optional(curve->rate_at(*speed).value()) : std::nullopt;
  };
  json.number("fastest_rate_hz", rate_of(curve->fastest_speed(question.load)));
  json.number("accelerated_rate_hz", rate_of(curve->fastest_speed(accelerated)));
  return json.take();
}

}  // namespace passo
