// passo loop: a motor with an encoder and a controller, and its response to a step.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "argument_units.hpp"
#include "commands.hpp"
#include "machine_motor.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/feedback/loop_trial.hpp"
#include "passo/motor/example_motor.hpp"
#include "passo/report/line_chart.hpp"

namespace passo {
namespace {

Result<MotorSetup, std::string> motor_of(const LoopArguments& arguments) {
  if (arguments.machine.empty()) {
    if (!arguments.axis.empty()) return Failure{std::string("--axis is an axis of a --machine")};
    return small_motor_setup("microsteps:64", {0.01});
  }
  auto setup = machine_motor(arguments.machine, arguments.axis);
  if (!setup) return setup;
  setup->excitation = *Excitation::named("microsteps:64");
  setup->weight = {};
  return setup;
}

PidGains gains_of(const std::vector<double>& values) {
  return {.kp = values[0], .ki = values[1], .kd = values[2]};
}

PidGains by_rule(const std::string& rule, const UltimateCycle& cycle) {
  if (rule == "p") return ziegler_nichols_p(cycle);
  return rule == "pi" ? ziegler_nichols_pi(cycle) : ziegler_nichols_pid(cycle);
}

// One controller and what it does.
struct Tried {
  std::string name;
  PidGains gains;
  std::vector<LoopMoment> moments;
  LoopFigures figures;
};

struct LoopStudy {
  LoopSetup setup;
  std::optional<UltimateCycle> cycle = {};  // of the loop that is shown, if a rule was asked for
  std::vector<Tried> tried = {};
};

Result<Unit, std::string> read_load(const std::string& text, LoopSetup& setup) {
  if (text.empty()) return Unit{};
  const std::size_t at = text.find('@');
  const auto number = [](std::string_view part, double& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size() && value >= 0 && value < 1e6;
  };
  double torque = 0;
  double time = 0;
  if (at == std::string::npos || !number(std::string_view(text).substr(0, at), torque) ||
      !number(std::string_view(text).substr(at + 1), time)) {
    return Failure{fmt::format("--load '{}': expected NM@S, e.g. 0.1@0.05", text)};
  }
  setup.load = {torque};
  setup.load_at = Seconds(time);
  return Unit{};
}

constexpr const char* no_swing =
    "the loop does not oscillate at any gain, so the rule does not apply: give --gains, another --period or a larger "
    "step";

Result<LoopStudy, std::string> prepared(const LoopArguments& arguments) {
  auto motor = motor_of(arguments);
  if (!motor) return Failure{motor.error()};
  LoopStudy study{.setup = {.motor = std::move(*motor),
                            .counts_per_turn = arguments.counts,
                            .period = Seconds(arguments.period_us * 1e-6),
                            .smoothing = Seconds(arguments.smoothing_us * 1e-6)}};
  LoopSetup& setup = study.setup;
  if (auto good = read_load(arguments.load, setup); !good) return Failure{good.error()};
  const bool places = arguments.of == "position";
  setup.to = places ? arguments.to.value_or(90) * radians_per_degree : arguments.to.value_or(30);
  if (setup.to == 0) return Failure{std::string("--to: expected a step other than 0")};
  if (!places) return study;
  if (!arguments.speed_gains.empty()) {
    setup.speed_gains = gains_of(arguments.speed_gains);
  } else {
    LoopSetup inner = setup;
    constexpr double usual_speed = 30;
    inner.to = usual_speed;
    const auto cycle = ultimate_cycle(inner);
    if (!cycle) return Failure{std::string(no_swing)};
    setup.speed_gains = ziegler_nichols_pi(*cycle);
  }
  setup.controlled = Controlled::position;
  return study;
}

Result<LoopStudy, std::string> studied(const LoopArguments& arguments) {
  auto study = prepared(arguments);
  if (!study) return study;
  const auto add = [&](const std::string& name, const PidGains& gains) {
    LoopSetup setup = study->setup;
    setup.gains = gains;
    Tried tried{.name = name, .gains = gains, .moments = step_response(setup, Seconds(arguments.time)), .figures = {}};
    tried.figures = figures_of(tried.moments, setup);
    study->tried.push_back(std::move(tried));
  };
  if (arguments.gains.empty() || arguments.compare) {
    study->cycle = ultimate_cycle(study->setup);
    if (!study->cycle) return Failure{std::string(no_swing)};
    for (const char* rule : {"p", "pi", "pid"}) {
      if (arguments.compare || arguments.rule == rule) {
        add(fmt::format("{} by the rule", rule), by_rule(rule, *study->cycle));
      }
    }
  }
  if (!arguments.gains.empty()) add("manual gains", gains_of(arguments.gains));
  return study;
}

nlohmann::ordered_json as_json(const PidGains& gains) {
  return {{"kp", gains.kp}, {"ki", gains.ki}, {"kd", gains.kd}};
}

void print_json(const LoopArguments& arguments, const LoopStudy& study) {
  nlohmann::ordered_json json = {{"of", arguments.of}, {"to", study.setup.to}, {"ultimate", nullptr}};
  if (study.cycle) json["ultimate"] = {{"gain", study.cycle->gain}, {"period_s", study.cycle->period.value()}};
  if (arguments.of == "position") json["speed_gains"] = as_json(study.setup.speed_gains);
  json["controllers"] = nlohmann::ordered_json::array();
  for (const Tried& tried : study.tried) {
    nlohmann::ordered_json own = {{"name", tried.name}, {"gains", as_json(tried.gains)}, {"rise_s", nullptr}};
    if (tried.figures.rise) own["rise_s"] = tried.figures.rise->value();
    own["overshoot"] = tried.figures.overshoot;
    own["settled_s"] = nullptr;
    if (tried.figures.settled) own["settled_s"] = tried.figures.settled->value();
    own["error"] = tried.figures.error;
    own["swing"] = tried.figures.swing;
    json["controllers"].push_back(own);
  }
  fmt::print("{}\n", json.dump(2));
}

std::string table_of(const LoopStudy& study) {
  std::string text = study.tried.size() > 1 ? "controller," : "";
  text += "time_s,wanted,counted,is,speed_rad_s,asked_nm,torque_nm\n";
  for (const Tried& tried : study.tried) {
    for (const LoopMoment& moment : tried.moments) {
      if (study.tried.size() > 1) text += tried.name + ",";
      text += fmt::format("{:.9g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", moment.time.value(), moment.wanted,
                          moment.counted, moment.is, moment.speed.value, moment.asked.value, moment.torque.value);
    }
  }
  return text;
}

LineChart chart_of(const LoopStudy& study) {
  const bool places = study.setup.controlled == Controlled::position;
  const double unit = places ? 1 / radians_per_degree : 1;
  LineChart chart{
      .x_title = "Time, ms", .y_title = places ? "Position of the shaft, degrees" : "Speed, rad/s", .lines = {}};
  for (const Tried& tried : study.tried) {
    ChartLine line{.name = tried.name, .points = {}};
    for (const LoopMoment& moment : tried.moments)
      line.points.emplace_back(1e3 * moment.time.value(), unit * moment.is);
    chart.lines.push_back(std::move(line));
  }
  // A single response has room for what the controller asked for.
  if (chart.lines.size() < 4) {
    ChartLine wanted{.name = "wanted", .points = {}};
    const double end = 1e3 * study.tried.front().moments.back().time.value();
    wanted.points = {{0, unit * study.setup.to}, {end, unit * study.setup.to}};
    chart.lines.push_back(std::move(wanted));
  }
  return chart;
}

std::string describe(const LoopStudy& study) {
  std::string words =
      fmt::format("{} counts/rev, {:g} \u00B5s", study.setup.counts_per_turn, study.setup.period.value() * 1e6);
  if (study.cycle) {
    words += fmt::format("   \u00B7   oscillates at a gain of {:.3g}, with a period of {:.3g} ms", study.cycle->gain,
                         1e3 * study.cycle->period.value());
  }
  if (study.setup.load.value > 0) {
    words += fmt::format("   \u00B7   load of {:g} N\u00B7m after {:g} ms", study.setup.load.value,
                         1e3 * study.setup.load_at.value());
  }
  return words;
}

Status<OutputError> write_file(const std::string& path, const LoopStudy& study) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return Failure{file.error()};
  Status<OutputError> done = Unit{};
  if (const auto format = picture_format_of(path)) {
    const PictureOptions options{
        .format = *format, .program = "Motor with an encoder: step response", .machine = describe(study)};
    done = draw_line_chart(chart_of(study), options, *file);
  } else {
    file->write(table_of(study));
  }
  if (done) done = file->commit();
  return done;
}

}  // namespace

int loop(const LoopArguments& arguments) {
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
  if (!outputs_are_apart({arguments.picture}, arguments.output)) return exit_bad_program;
  const auto study = studied(arguments);
  if (!study) return fail(exit_bad_program, study.error());
  for (const std::string& path : {arguments.picture, arguments.output}) {
    if (path.empty()) continue;
    const Status<OutputError> done = write_file(path, *study);
    if (!done) return fail(exit_failed, done.error().message);
  }
  if (arguments.json) {
    print_json(arguments, *study);
  } else if (arguments.picture.empty() && arguments.output.empty()) {
    std::fputs(table_of(*study).c_str(), stdout);
  }
  return exit_done;
}

}  // namespace passo
