#include <cmath>

#include "json_text.hpp"

#include "passo/lab/answers.hpp"

namespace passo {
namespace {

// Empty: the setup can be tried.
std::string wrong_in(const LoopSetup& setup) {
  for (const Status<MotorError>& good : {check(setup.motor.motor), check(setup.motor.drive), check(setup.motor.load)}) {
    if (!good) return good.error().message;
  }
  if (setup.counts_per_turn < 4 || setup.counts_per_turn > 1'000'000)
    return "expected 4 to 1000000 counts per revolution";
  if (!(setup.period.value() >= 1e-5 && setup.period.value() <= 0.1)) return "expected a period of 10 µs to 0.1 s";
  if (!std::isfinite(setup.to) || setup.to == 0) return "expected a step other than 0";
  return {};
}

std::string gains_text(const PidGains& gains) {
  JsonText json;
  json.number("kp", gains.kp);
  json.number("ki", gains.ki);
  json.number("kd", gains.kd);
  return json.take();
}

std::optional<double> seconds_of(const std::optional<Seconds>& time) {
  return time ? std::optional(time->value()) : std::nullopt;
}

}  // namespace

std::string loop_answer(const LoopSetup& setup, Seconds whole) {
  if (const std::string words = wrong_in(setup); !words.empty()) return error_answer(words);
  if (!(whole >= setup.period && whole / setup.period <= static_cast<double>(most_entries))) {
    return error_answer(fmt::format("expected a time of 1 to {} periods", most_entries));
  }
  const std::vector<LoopMoment> moments = step_response(setup, whole);
  const LoopFigures figures = figures_of(moments, setup);
  std::vector<double> time;
  std::vector<double> counted;
  std::vector<double> is;
  std::vector<double> asked;
  std::vector<double> torque;
  for (const LoopMoment& moment : moments) {
    time.push_back(moment.time.value());
    counted.push_back(moment.counted);
    is.push_back(moment.is);
    asked.push_back(moment.asked.value);
    torque.push_back(moment.torque.value);
  }
  JsonText json;
  json.number("wanted", setup.to);
  json.list("time_s", time);
  json.list("counted", counted);
  json.list("is", is);
  json.list("asked_nm", asked);
  json.list("torque_nm", torque);
  json.number("rise_s", seconds_of(figures.rise));
  json.number("overshoot", figures.overshoot);
  json.number("settled_s", seconds_of(figures.settled));
  json.number("steady_error", figures.error);
  json.number("swing", figures.swing);
  return json.take();
}

std::string ultimate_answer(const LoopSetup& setup) {
  if (const std::string words = wrong_in(setup); !words.empty()) return error_answer(words);
  const std::optional<UltimateCycle> cycle = ultimate_cycle(setup);
  if (!cycle) return error_answer("the loop does not oscillate at any gain");
  JsonText json;
  json.number("gain", cycle->gain);
  json.number("period_s", cycle->period.value());
  json.raw("p", gains_text(ziegler_nichols_p(*cycle)));
  json.raw("pi", gains_text(ziegler_nichols_pi(*cycle)));
  json.raw("pid", gains_text(ziegler_nichols_pid(*cycle)));
  return json.take();
}

}  // namespace passo
