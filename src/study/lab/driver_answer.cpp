#include <algorithm>
#include <cmath>

#include "json_text.hpp"

#include "passo/lab/answers.hpp"

namespace passo {
namespace {

constexpr double diode_drop = 0.7;  // V
constexpr int periods = 2;          // of the winding's current
constexpr int points_of_period = 600;
constexpr int torque_rates = 160;

struct Stage {
  const char* name;
  WindingCircuit circuit;
};

std::vector<Stage> stages_of(const DriverQuestion& question) {
  WindingCircuit plain{.supply = question.supply,
                       .drop = question.transistor.saturation,
                       .diode = {diode_drop},
                       .winding = question.motor.resistance,
                       .series = {},
                       .inductance = question.motor.inductance};
  WindingCircuit raised = plain;
  raised.supply = question.raised;
  WindingCircuit chopper = raised;
  raised.series = question.series;
  chopper.limit = question.motor.rated_current;
  chopper.ripple = question.ripple;
  return {{"plain", plain}, {"series", raised}, {"chopper", chopper}};
}

std::string wrong_in(const DriverQuestion& question) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(question.rate.value())) return "the step rate must be above 0";
  if (!positive(question.transistor.gain)) return "the gain must be above 0";
  if (!positive(question.base.value)) return "the base resistor must be above 0 ohm";
  if (!positive(question.logic.value - question.transistor.base_emitter.value)) {
    return "the logic's voltage must be above the base's";
  }
  if (!(question.reserve >= 0)) return "the reserve must be 0 or more";
  if (const auto good = check(question.motor); !good) return good.error().message;
  for (const Stage& stage : stages_of(question)) {
    if (const auto good = check(stage.circuit); !good) return good.error().message;
  }
  return {};
}

// The torque of the motor with this stage. A stage that pushes more or less than the rated current makes another
// motor of it: the torque of an ampere is the same.
Result<TorqueCurve, MotorError> torque_with(const DriverQuestion& question, const WindingCircuit& circuit) {
  MotorData motor = question.motor;
  motor.winding = Winding::half_coil;
  motor.resistance.value += circuit.series.value;
  const bool chops = circuit.limit.has_value();
  if (!chops) {
    motor.holding_torque.value *= circuit.final().value / motor.rated_current.value;
    motor.rated_current = circuit.final();
  }
  return TorqueCurve::from_motor(motor, {.supply = circuit.supply,
                                         .winding = Winding::half_coil,
                                         .regulation = chops ? Regulation::chopper : Regulation::resistive,
                                         .drop = circuit.drop});
}

// Over the last period, a fraction of the time and of the squares: what heats.
struct Means {
  double current = 0;
  double square = 0;
  double pushed = 0;  // while the transistor is on
};

void put_current(JsonText& json, const DriverQuestion& question, const WindingCircuit& circuit) {
  const double half = 2 / question.rate.value();  // on for two steps
  const double apart = 2 * half / points_of_period;
  WindingCurrent winding(circuit);
  std::vector<double> times = {0};
  std::vector<double> currents = {0};
  Means means;
  for (int period = 0; period < periods; ++period) {
    for (int i = 0; i < points_of_period; ++i) {
      const bool on = i < points_of_period / 2;
      if (i == 0 || i == points_of_period / 2) winding.switch_to(on ? 1 : 0);
      const double before = winding.now().value;
      winding.run(Seconds(apart));
      times.push_back(2 * half * period + (i + 1) * apart);
      currents.push_back(winding.now().value);
      if (period + 1 < periods) continue;
      const double mean = (before + winding.now().value) / 2;
      means.current += mean / points_of_period;
      means.square += mean * mean / points_of_period;
      if (on) means.pushed += mean / points_of_period;
    }
  }
  json.list("time_s", times);
  json.list("current_a", currents);
  json.number("most_a", *std::max_element(currents.begin(), currents.end()));
  json.number("winding_w", means.square * circuit.winding.value);
  json.number("series_w", means.square * circuit.series.value);
  json.number("transistor_w", means.pushed * circuit.drop.value);
}

std::string answer_of(const DriverQuestion& question, const WindingCircuit& circuit, const TorqueCurve& torque,
                      Hertz end) {
  JsonText json;
  json.number("final_a", circuit.final().value);
  json.number("tau_s", circuit.time_constant().value());
  const auto reached = circuit.rise_time({0.9 * question.motor.rated_current.value});
  json.number("rise_s", reached ? std::optional(reached->value()) : std::nullopt);
  put_current(json, question, circuit);
  std::vector<double> hertz;
  std::vector<double> pull_out;
  for (int i = 0; i < torque_rates; ++i) {
    hertz.push_back(end.value() * i / (torque_rates - 1));
    pull_out.push_back(torque.pull_out(torque.speed_at(Hertz(hertz.back()))).value);
  }
  json.list("rate_hz", hertz);
  json.list("pull_out_nm", pull_out);
  return json.take();
}

std::string base_answer(const DriverQuestion& question) {
  const BaseResistor base = base_resistor_of(question.transistor, question.motor.rated_current, question.logic,
                                             question.reserve, question.base);
  JsonText json;
  json.number("needed_a", base.needed.value);
  json.number("wanted_a", base.wanted.value);
  json.number("largest_ohm", base.largest.value);
  json.number("given_a", base.given.value);
  json.number("overdrive", base.overdrive);
  json.number("heat_w", base.heat.value);
  json.number("warmer_k", base.warmer);
  return json.take();
}

}  // namespace

std::string driver_answer(const DriverQuestion& question) {
  if (const std::string words = wrong_in(question); !words.empty()) return error_answer(words);
  const std::vector<Stage> stages = stages_of(question);
  std::vector<TorqueCurve> curves;
  Hertz end(HUGE_VAL);
  for (const Stage& stage : stages) {
    auto curve = torque_with(question, stage.circuit);
    if (!curve) return error_answer(curve.error().message);
    // A little beyond the stage that is first without torque.
    end = std::min(end, Hertz(1.5 * natural_end(*curve, {}).value()));
    curves.push_back(*curve);
  }
  JsonText json;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    json.raw(stages[i].name, answer_of(question, stages[i].circuit, curves[i], end));
  }
  json.raw("base", base_answer(question));
  return json.take();
}

}  // namespace passo
