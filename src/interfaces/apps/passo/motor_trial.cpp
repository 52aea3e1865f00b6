#include "motor_trial.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "program_input.hpp"
#include "run_outputs.hpp"
#include <fmt/format.h>

#include "passo/motor/motor_trials.hpp"
#include "passo/report/line_chart.hpp"

namespace passo {
namespace {

struct Study {
  std::string title;
  std::string table;  // CSV with a header
  LineChart chart;
};

Hertz rate_of_row(const MotorArguments& arguments, Hertz end, int row) {
  return Hertz(end.value() * (row + 1) / arguments.rows);
}

Study try_torque(const MotorArguments& arguments, const MotorSetup& setup, Hertz end) {
  Study study{
      .title = "Stepping motor: simulated torque",
      .table = "rate_hz,pull_out_nm,pull_in_nm\n",
      .chart = {.x_title = "Rate, full steps/s",
                .y_title = "Load torque, N\u00B7m",
                .lines = {{.name = "Pull-out torque", .points = {}}, {.name = "Pull-in torque", .points = {}}}}};
  for (int row = 0; row < arguments.rows; ++row) {
    const Hertz rate = rate_of_row(arguments, end, row);
    const double out = tried_pull_out(setup, rate).value;
    const double in = tried_pull_in(setup, rate).value;
    study.table += fmt::format("{:.10g},{:.6g},{:.6g}\n", rate.value(), out, in);
    study.chart.lines[0].points.emplace_back(rate.value(), out);
    study.chart.lines[1].points.emplace_back(rate.value(), in);
  }
  return study;
}

Study try_resonance(const MotorArguments& arguments, const MotorSetup& setup, Hertz end) {
  Study study{.title = "Stepping motor: lag of the rotor at a constant rate",
              .table = "rate_hz,most_lag_full_steps\n",
              .chart = {.x_title = "Rate, full steps/s",
                        .y_title = "Largest lag, full steps (2: steps are lost)",
                        .lines = {{.name = "largest lag", .points = {}}}}};
  for (int row = 0; row < arguments.rows; ++row) {
    const Hertz rate = rate_of_row(arguments, end, row);
    const double lag = tried_lag(setup, rate);
    study.table += fmt::format("{:.10g},{:.6g}\n", rate.value(), lag);
    study.chart.lines[0].points.emplace_back(rate.value(), lag);
  }
  return study;
}

// One step, or several that end without a ramp.
Study try_motion(const MotorArguments& arguments, const MotorSetup& setup) {
  constexpr int rows_at_least = 400;
  const int steps = arguments.trial == "step" ? 1 : arguments.trial_steps;
  const Hertz rate(arguments.trial_rate);
  const double driven = steps / (rate.value() * setup.excitation.steps_per_full_step());
  const Seconds whole(driven + arguments.trial_after);
  const Seconds apart(whole.value() / std::max(arguments.rows - 1, rows_at_least));
  Study study{.title = steps == 1 ? "Stepping motor: response to one step" : "Stepping motor: steps and a stop",
              .table = "time_s,commanded_full_steps,place_full_steps,speed_rad_s,current_a,current_b,torque_nm\n",
              .chart = {.x_title = "Time, ms",
                        .y_title = "Full steps",
                        .lines = {{.name = "commanded", .points = {}}, {.name = "the rotor", .points = {}}}}};
  for (const MotorMoment& moment : tried_motion(setup, steps, rate, whole, apart)) {
    study.table += fmt::format("{:.9g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", moment.time.value(),
                               moment.commanded, moment.place, moment.speed.value, moment.current_a.value,
                               moment.current_b.value, moment.torque.value);
    const double milliseconds = moment.time.value() * 1e3;
    auto& commanded = study.chart.lines[0].points;
    if (!commanded.empty()) commanded.emplace_back(milliseconds, commanded.back().second);
    commanded.emplace_back(milliseconds, moment.commanded);
    study.chart.lines[1].points.emplace_back(milliseconds, moment.place);
  }
  return study;
}

}  // namespace

int try_motor(const MotorArguments& arguments, const MotorSetup& motor, Hertz end, const std::string& words) {
  const Study study = arguments.trial == "torque"      ? try_torque(arguments, motor, end)
                      : arguments.trial == "resonance" ? try_resonance(arguments, motor, end)
                                                       : try_motion(arguments, motor);
  for (const std::string& path : arguments.pictures) {
    Result<OutputFile, OutputError> file = OutputFile::open(path);
    if (!file) return fail(exit_failed, file.error().message);
    const PictureOptions options{.format = *picture_format_of(path), .program = study.title, .machine = words};
    Status<OutputError> done = draw_line_chart(study.chart, options, *file);
    if (done) done = file->commit();
    if (!done) return fail(exit_failed, done.error().message);
  }
  if (arguments.pictures.empty()) std::fputs(study.table.c_str(), stdout);
  return exit_done;
}

}  // namespace passo
