#include <cmath>

#include "json_text.hpp"

#include "passo/lab/answers.hpp"
#include "passo/ramp/ideal_rates.hpp"

namespace passo {
namespace {

// Empty: the request can be tried.
std::string wrong_in(const RampRequest& request) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  const auto not_negative = [](double value) { return std::isfinite(value) && value >= 0; };
  if (!positive(request.setup.clock.value())) return "the clock must be above 0 Hz";
  if (!positive(request.setup.acceleration.value)) return "the acceleration must be above 0 rad/s²";
  if (request.setup.steps_per_turn < 1) return "expected at least one step per revolution";
  if (request.steps < 1 || request.steps > most_entries) return fmt::format("expected 1 to {} steps", most_entries);
  if (request.table_size < 0 || request.table_size > RampSequence::largest_table) {
    return fmt::format("expected a table of 0 to {} entries", RampSequence::largest_table);
  }
  if (!not_negative(request.rate.value()) || !not_negative(request.start.value()) ||
      !not_negative(request.jerk.value)) {
    return "expected a rate and a jerk of 0 or more";
  }
  return {};
}

}  // namespace

std::string ramp_answer(const RampRequest& request) {
  if (const std::string words = wrong_in(request); !words.empty()) return error_answer(words);
  auto sequence = RampSequence::start(request);
  if (!sequence) return error_answer(sequence.error().message);
  RampRequest reference = request;
  reference.method = RampMethod::exact;
  reference.whole_ticks = false;
  reference.jerk = {0};
  auto exact = RampSequence::start(reference);
  if (!exact) return error_answer(exact.error().message);
  std::vector<double> ticks;
  std::vector<double> errors;
  std::vector<double> ends;
  double total = 0;
  // A move with bounded jerk may not be longer than it says.
  while (!sequence->done() && static_cast<std::int64_t>(ticks.size()) < most_entries) {
    ticks.push_back(sequence->next());
    errors.push_back(exact->done() ? 0 : ticks.back() - exact->next());
    total += ticks.back();
    ends.push_back(total / request.setup.clock.value());
  }
  double ideal_ticks = 0;
  for (auto whole = RampSequence::start(reference); !whole->done();) ideal_ticks += whole->next();
  std::vector<double> ideal_times;
  std::vector<double> ideal;
  for (const IdealRate& point : ideal_rates(reference, ideal_ticks / request.setup.clock.value())) {
    ideal_times.push_back(point.time);
    ideal.push_back(point.rate);
  }
  JsonText json;
  json.number("first_interval", first_interval(request.setup));
  json.flag("whole_ticks", sequence->whole_ticks());
  json.list("ticks", ticks);
  json.list("error_ticks", errors);
  json.list("end_s", ends);
  json.list("ideal_time_s", ideal_times);
  json.list("ideal_rate_hz", ideal);
  return json.take();
}

}  // namespace passo
