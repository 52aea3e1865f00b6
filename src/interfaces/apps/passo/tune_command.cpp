// passo tune: limits for the axes of a machine, from what its motors can do.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/activity/machine_plant.hpp"
#include "passo/operations/study_arguments.hpp"
#include "passo/report/line_chart.hpp"
#include "passo/toml/toml_text.hpp"
#include "passo/tuning/tuning_run.hpp"

namespace passo {
namespace {

const char* unit_of(Axis axis) {
  return is_rotary(axis) ? "deg" : "mm";
}

const AxisDescription& description(const MachineDescription& machine, Axis axis) {
  return *std::ranges::find(machine.axes, axis, &AxisDescription::axis);
}

// A value of the machine file, before and after.
struct SetValue {
  std::string path;
  double before = 0;  // 0: not given
  double after = 0;
};

std::vector<SetValue> values_of(const MachineDescription& before, const TunedMachine& tuned) {
  std::vector<SetValue> values;
  for (const AxisTuning& tuning : tuned.axes) {
    const AxisDescription& old = description(before, tuning.axis);
    const AxisDescription& axis = description(tuned.machine, tuning.axis);
    const std::string unit = unit_of(tuning.axis);
    const auto add = [&](const std::string& key, double was, double is) {
      values.push_back({fmt::format("axis.{}.{}", letter_of(tuning.axis), key), was, is});
    };
    add("max_velocity_" + unit + "_s", old.velocity.value(), axis.velocity.value());
    add("max_acceleration_" + unit + "_s2", old.acceleration.value(), axis.acceleration.value());
    add("max_jerk_" + unit + "_s3", old.jerk.value(), axis.jerk.value());
    if (axis.start_stop != old.start_stop) {
      add("start_stop_velocity_" + unit + "_s", old.start_stop.value(), axis.start_stop.value());
    }
    if (!axis.home) continue;
    if (axis.home->seek != old.home->seek) {
      add("home.seek_" + unit + "_s", old.home->seek.value(), axis.home->seek.value());
    }
    if (axis.home->latch != old.home->latch) {
      add("home.latch_" + unit + "_s", old.home->latch.value(), axis.home->latch.value());
    }
  }
  return values;
}

std::string bound_words(const AxisTuning& tuning) {
  switch (tuning.bound) {
    case TuningBound::time: return "a higher velocity would save no time";
    case TuningBound::torque: return "above that velocity no torque is left to accelerate";
    case TuningBound::board: return "the board cannot make a higher velocity";
    case TuningBound::wish: return "a higher velocity is not allowed, or causes resonance";
    case TuningBound::swing: break;
  }
  return "above that velocity the motor may lose steps through resonance";
}

std::string to_text(const TunedMachine& tuned, const std::vector<SetValue>& values) {
  std::string text;
  for (const AxisTuning& tuning : tuned.axes) {
    text +=
        fmt::format("axis {}: {:.0f} % of the guaranteed torque is reserved; {:g} {} takes {:.3f} s\n",
                    letter_of(tuning.axis), 100 * tuning.margin, tuning.way, unit_of(tuning.axis), tuning.time.value());
    const std::string own = fmt::format("axis.{}.", letter_of(tuning.axis));
    for (const SetValue& value : values) {
      if (!value.path.starts_with(own)) continue;
      const std::string was = value.before > 0 ? fmt::format("was {:.6g}", value.before) : "was not given";
      text += fmt::format("  {:<28} = {:<10.6g} # {}\n", value.path.substr(own.size()), value.after, was);
    }
    text += fmt::format("  the rotor oscillates at {:.1f} Hz with that load; {}\n", 1 / tuning.period.value(),
                        bound_words(tuning));
  }
  return text + fmt::format("verdict for strokes, zigzags and circles: {}\n", name_of(tuned.verdict));
}

nlohmann::ordered_json as_json(const TunedMachine& tuned, const std::vector<SetValue>& values) {
  const char* const bounds[] = {"time", "torque", "board", "wish", "swing"};
  nlohmann::ordered_json axes = nlohmann::ordered_json::array();
  for (const AxisTuning& tuning : tuned.axes) {
    axes.push_back({{"axis", std::string(1, letter_of(tuning.axis))},
                    {"margin", tuning.margin},
                    {"velocity", tuning.velocity.value()},
                    {"acceleration", tuning.acceleration.value()},
                    {"jerk", tuning.jerk.value()},
                    {"bound", bounds[static_cast<std::size_t>(tuning.bound)]},
                    {"ringing_hz", 1 / tuning.period.value()},
                    {"way", tuning.way},
                    {"time_s", tuning.time.value()}});
  }
  nlohmann::ordered_json set = nlohmann::ordered_json::array();
  for (const SetValue& value : values) {
    set.push_back({{"key", value.path}, {"before", value.before}, {"after", value.after}});
  }
  return {{"verdict", name_of(tuned.verdict)}, {"axes", axes}, {"values", set}};
}

LineChart chart_of(const AxisTuning& tuning) {
  LineChart chart{.x_title = fmt::format("Axis {}, {}/s", letter_of(tuning.axis), unit_of(tuning.axis)),
                  .y_title = "Torque at the shaft, N\u00B7m",
                  .lines = {{.name = "guaranteed pull-out torque", .points = {}},
                            {.name = "range of possible resonance", .points = {}},
                            {.name = "less the margin", .points = {}},
                            {.name = "needed", .points = {}}}};
  for (const TuningPoint& point : tuning.curve) {
    const double speed = point.speed.value();
    chart.lines[0].points.emplace_back(speed, point.pull_out.value);
    chart.lines[1].points.emplace_back(speed, point.steady.value);
    chart.lines[2].points.emplace_back(speed, point.usable.value);
    auto& needed = chart.lines[3].points;
    // From the proposed velocity on only friction is needed: a step down.
    if (!needed.empty() && point.speed > tuning.velocity && needed.back().first < tuning.velocity.value()) {
      needed.emplace_back(tuning.velocity.value(), needed.back().second);
      needed.emplace_back(tuning.velocity.value(), point.needed.value);
    }
    needed.emplace_back(speed, point.needed.value);
  }
  return chart;
}

Status<OutputError> draw(const TunedMachine& tuned, const std::string& path) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return Failure{file.error()};
  std::vector<LineChart> charts;
  for (const AxisTuning& tuning : tuned.axes) charts.push_back(chart_of(tuning));
  const PictureOptions options{.format = *picture_format_of(path),
                               .program = "Available torque, and torque that the proposed limits need",
                               .machine = tuned.machine.name};
  Status<OutputError> done = draw_line_charts(charts, options, *file);
  if (done) done = file->commit();
  return done;
}

// Empty: some letter is no axis whose motor the machine file describes. The message went to standard error.
std::vector<Axis> axes_of(const TuneArguments& arguments, const MachineDescription& machine) {
  std::vector<Axis> axes;
  for (const AxisDescription& axis : machine.axes) {
    const bool is_wanted = arguments.axes.empty() || arguments.axes.find(letter_of(axis.axis)) != std::string::npos;
    if (is_wanted && motor_setup(axis)) axes.push_back(axis.axis);
  }
  if (axes.empty() || (!arguments.axes.empty() && axes.size() != arguments.axes.size())) {
    const std::string which = arguments.axes.empty() ? "any axis" : "each of " + arguments.axes;
    fail(exit_bad_machine, fmt::format("{} does not describe the motor of {}: expected a table [axis.X.torque], and a "
                                       "whole number of microsteps per full step",
                                       arguments.machine, which));
    return {};
  }
  return axes;
}

Result<std::string, std::string> copy_of(const std::string& text, const std::vector<SetValue>& values) {
  auto toml = TomlText::read(text);
  if (!toml) return Failure{toml.error().message};
  for (const SetValue& value : values) {
    if (auto done = toml->set(value.path, value.after); !done) return Failure{done.error().message};
  }
  return toml->text();
}

// The copy must be a sound machine file itself. Returns an exit code.
int write_copy(const TuneArguments& arguments, const std::string& text, const std::vector<SetValue>& values) {
  const auto copy = copy_of(text, values);
  if (!copy) return fail(exit_failed, fmt::format("{}: {}", arguments.machine, copy.error()));
  Diagnostics diagnostics;
  if (!parse_machine(*copy, arguments.output, diagnostics)) {
    show(diagnostics);
    return fail(exit_bad_machine, arguments.output + " would not be a valid machine file, so it was not written");
  }
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.output);
  if (!file) return fail(exit_failed, file.error().message);
  file->write(*copy);
  const Status<OutputError> done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

}  // namespace

int tune(const TuneArguments& arguments) {
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
  NamedFiles files;
  files.reads("the machine file", arguments.machine);
  files.writes("--output", arguments.output);
  files.writes("--picture", arguments.picture);
  if (!files.are_apart()) return exit_bad_program;
  Diagnostics diagnostics;
  const auto text = machine_file_text(arguments.machine, diagnostics);
  const auto machine = text ? parse_machine(*text, arguments.machine, diagnostics) : std::nullopt;
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  const std::vector<Axis> axes = axes_of(arguments, *machine);
  if (axes.empty()) return exit_bad_machine;

  const auto result = tuned(*machine, {.wish = {.margin = arguments.margin, .way = arguments.way.value_or(0)},
                                       .axes = axes,
                                       .keep_velocity = arguments.keep_velocity});
  if (!result) return fail(exit_failed, result.error().message + " [tune.impossible]");
  const std::vector<SetValue> values = values_of(*machine, *result);
  if (!arguments.picture.empty()) {
    const Status<OutputError> done = draw(*result, arguments.picture);
    if (!done) return fail(exit_failed, done.error().message);
  }
  if (!arguments.output.empty()) {
    const int code = write_copy(arguments, *text, values);
    if (code != exit_done) return code;
  }
  if (arguments.output != "-") {
    const std::string words = arguments.json ? as_json(*result, values).dump(2) + "\n" : to_text(*result, values);
    std::fputs(words.c_str(), stdout);
  }
  if (result->verdict == Verdict::safe) return exit_done;
  return fail(exit_failed, "no safe limits were found; the last ones that were tried are shown [tune.not-safe]");
}

}  // namespace passo
