#include "ramp_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/ramp/ideal_rates.hpp"
#include "passo/ramp/s_curve_move.hpp"

namespace passo {
namespace {

constexpr std::int64_t most_samples = 3000;

bool shown(const RampRequest& request, std::int64_t n) {
  const std::int64_t stride = 1 + request.steps / most_samples;
  return n % stride == 0;
}

RampRequest by(RampMethod method, RampRequest request, bool whole_ticks) {
  request.method = method;
  request.whole_ticks = whole_ticks;
  return request;
}

// The intervals of a method, each with its difference from the exact interval of the same step.
Result<RampTrace, RampError> trace_of(const std::string& name, const RampRequest& request) {
  RampRequest reference = by(RampMethod::exact, request, false);
  reference.jerk = {0};
  Result<RampSequence, RampError> sequence = RampSequence::start(request);
  if (!sequence) return Failure{sequence.error()};
  Result<RampSequence, RampError> exact = RampSequence::start(reference);
  if (!exact) return Failure{exact.error()};
  const double tick = 1 / request.setup.clock.value();
  RampTrace trace{.name = name, .samples = {}};
  long double total = 0;
  std::int64_t place = 0;
  for (std::int64_t n = 0; !sequence->done(); ++n) {
    const double interval = sequence->next();
    const double real = exact->done() ? interval : exact->next();
    const bool back = sequence->place() < place;
    place = sequence->place();
    const double begin = static_cast<double>(total) * tick;
    total += interval;
    if (!shown(request, n) && !sequence->done()) continue;
    trace.samples.push_back({.n = static_cast<double>(n),
                             .begin = begin,
                             .end = static_cast<double>(total) * tick,
                             .ticks = interval,
                             .error = interval - real,
                             .back = back});
  }
  return trace;
}

// Adds the S-curve's own rate and acceleration at each of its steps.
void add_s_curve(const RampRequest& request, RampScene& scene) {
  const double rate = request.rate > Hertz(0) ? request.rate.value() : HUGE_VAL;
  SCurveMove move({.setup = request.setup, .jerk = request.jerk, .rate = Hertz(rate), .start = request.start});
  move.move_to({request.steps});
  double time = 0;
  scene.ideal.push_back({0, std::min(request.start.value(), rate)});
  scene.acceleration.push_back({0, 0});
  for (std::int64_t n = 0; !move.done(); ++n) {
    move.next();
    time += move.real_interval() / request.setup.clock.value();
    if (n + 1 == request.stop_after) move.stop();
    if (n + 1 == request.reverse_after) move.move_to({0});
    if (!shown(request, n) && !move.done()) continue;
    const double now = move.done() ? std::min(request.start.value(), rate) : move.rate().value();
    const double sense = move.up() ? 1 : -1;
    scene.ideal.push_back({time, sense * now});
    scene.acceleration.push_back({time, sense * move.acceleration().value});
  }
}

}  // namespace

Result<RampScene, RampError> ramp_scene(const RampRequest& request) {
  RampScene scene;
  scene.tick = 1 / request.setup.clock.value();
  const auto add = [&](const char* name, const RampRequest& wanted) -> Status<RampError> {
    Result<RampTrace, RampError> trace = trace_of(name, wanted);
    if (!trace) return Failure{trace.error()};
    scene.traces.push_back(std::move(*trace));
    return Unit{};
  };
  if (request.jerk.value > 0) {
    const Status<RampError> curve = add("limited jerk", by(request.method, request, true));
    if (!curve) return Failure{curve.error()};
    RampRequest without = by(RampMethod::exact, request, true);
    without.jerk = {0};
    const Status<RampError> trapezoid = add("constant acceleration", without);
    if (!trapezoid) return Failure{trapezoid.error()};
    scene.ideal_name = "rate between the steps";
    add_s_curve(request, scene);
    return scene;
  }
  const Status<RampError> exact = add("exact, whole ticks", by(RampMethod::exact, request, true));
  if (!exact) return Failure{exact.error()};
  if (request.method == RampMethod::midpoint) {
    const Status<RampError> midpoint = add("midpoint", by(RampMethod::midpoint, request, false));
    if (!midpoint) return Failure{midpoint.error()};
  }
  const Status<RampError> recursive = add("recursive", by(RampMethod::recursive, request, false));
  if (!recursive) return Failure{recursive.error()};
  // If K_b is too long for a table, the picture shows the other methods only. But a request for the table then fails.
  const Status<RampError> table =
      request.method == RampMethod::midpoint ? Unit{} : add("table", by(RampMethod::table, request, true));
  if (!table && request.method == RampMethod::table) return Failure{table.error()};
  if (request.stop_after > 0 || request.reverse_after > 0)
    return scene;  // the move changes on the way, so the intended rate does not apply
  scene.ideal_name = "ideal";
  for (const IdealRate& point : ideal_rates(request, scene.traces.front().samples.back().end)) {
    scene.ideal.push_back({point.time, point.rate});
  }
  return scene;
}

std::string ramp_title(const RampRequest& request) {
  if (!request.whole_move) return "Acceleration ramp: the first " + counted(request.steps, "step");
  return fmt::format("A move of {}{}", counted(request.steps, "step"),
                     request.jerk.value > 0 ? " with limited jerk" : "") +
         (request.stop_after > 0 ? fmt::format(", stopped after {}", request.stop_after) : "") +
         (request.reverse_after > 0 ? fmt::format(", reversed after {}", request.reverse_after) : "");
}

std::string ramp_words(const RampRequest& request) {
  const char* const dot = "   \u00B7   ";
  std::string words =
      fmt::format("clock {} Hz{}{} steps/rev{}{} rad/s\u00B2{}K_b = {:.1f} ticks",
                  sensible_number(request.setup.clock.value()), dot, request.setup.steps_per_turn, dot,
                  sensible_number(request.setup.acceleration.value), dot, first_interval(request.setup));
  if (first_interval(request.setup) >= 65536 && !(request.jerk.value > 0)) words += ", too long for a table";
  if (request.rate > Hertz(0)) words += fmt::format("{}up to {} steps/s", dot, sensible_number(request.rate.value()));
  if (request.start > Hertz(0))
    words += fmt::format("{}starts at {} steps/s", dot, sensible_number(request.start.value()));
  if (request.jerk.value > 0) words += fmt::format("{}{:g} rad/s\u00B3", dot, request.jerk.value);
  return words;
}

}  // namespace passo
