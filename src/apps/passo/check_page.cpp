#include "check_page.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "progress_display.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/activity/stage_options.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/report/summary_builder.hpp"
#include "passo/trajectory/planner.hpp"
#include "passo/verdict/margin_words.hpp"

namespace passo {
namespace {

// 0:12:31
std::string clock_words(Seconds time) {
  const auto seconds = static_cast<long long>(std::llround(time.value()));
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

const AxisDescription& description_of(const MachineDescription& machine, Axis axis) {
  return *std::ranges::find(machine.axes, axis, &AxisDescription::axis);
}

std::string axis_words(const AxisSummary& moved, const AxisDescription& axis) {
  const char* unit = is_rotary(axis.axis) ? "deg" : "mm";
  std::string words = fmt::format("axis {}          ", letter_of(axis.axis));
  if (!moved.machine_extents) return words + "does not move\n";
  return words +
         fmt::format("{:.3f} to {:.3f} {unit} of {:g} to {:g}; {:.4g} {unit}/s of {:g}, {:.4g} {unit}/s2 of {:.4g}\n",
                     moved.machine_extents->low, moved.machine_extents->high, axis.travel_low, axis.travel_high,
                     moved.peak_speed.value(), axis.velocity.value(), moved.peak_acceleration.value(),
                     axis.acceleration.value(), fmt::arg("unit", unit));
}

std::string motor_words(const CheckPage& page) {
  if (!page.knows_motors) return "";
  std::string words = fmt::format("motors          {}", name_of(page.margin.verdict));
  if (page.margin.verdict == Verdict::safe) words += ": they have the torque, weak ones too";
  if (page.margin.verdict == Verdict::doubtful) words += ": weak motors may lose steps";
  if (page.margin.verdict == Verdict::lost) words += ": they lose steps";
  words += "\n";
  for (const AxisMargin& axis : page.margin.axes) {
    words += fmt::format("  {}             ", letter_of(axis.axis));
    words += axis.worst ? fmt::format("at most in line {}: {}\n", axis.worst->line, cause_of(*axis.worst))
                        : "does not move\n";
  }
  for (const MarginSpot& spot : page.margin.worst) {
    if (spot.verdict == Verdict::safe) break;
    words += fmt::format("  line {:<9}{}: {}; {}\n", spot.line, name_of(spot.verdict), cause_of(spot), cure_of(spot));
  }
  return words;
}

nlohmann::ordered_json as_json(const MarginSpot& spot) {
  const char* const wants[] = {"torque", "jump", "calm"};
  nlohmann::ordered_json json = {{"line", spot.line},
                                 {"axis", std::string(1, letter_of(spot.axis))},
                                 {"verdict", name_of(spot.verdict)},
                                 {"want", wants[static_cast<std::size_t>(spot.want)]},
                                 {"time_s", spot.time.value()},
                                 {"needed_nm", spot.needed.value},
                                 {"low_nm", spot.there.low.value},
                                 {"high_nm", spot.there.high.value},
                                 {"full_steps_s", spot.rate.value()},
                                 {"acceleration", spot.acceleration.value()},
                                 {"cause", cause_of(spot)}};
  if (spot.safe_acceleration) json["safe_acceleration"] = spot.safe_acceleration->value();
  if (spot.safe_path_speed) json["safe_feed_mm_min"] = 60 * spot.safe_path_speed->value();
  if (spot.verdict != Verdict::safe) json["cure"] = cure_of(spot);
  return json;
}

}  // namespace

CheckPage judge(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const ProgramCheck& check, PathRecorder* path) {
  ProgressDisplay progress(program.name());
  Diagnostics findings;  // after a good check only what is known already
  Program activity(std::move(program), machine, options, no_answers(), findings, check.nominal_time);
  std::vector<Axis> axes;
  for (const AxisDescription& axis : machine.axes) axes.push_back(axis.axis);
  SummaryBuilder builder(axes);
  MarginSurvey survey(surveyed_motors(machine), step_grid(machine));
  CheckPage page;
  std::uint64_t segments = 0;
  activity.operations().watch([&](const Operation& operation) { builder.watch_operation(operation); });
  activity.path().watch([&](const PathItem& item) {
    builder.watch_path(item);
    if (std::holds_alternative<Segment>(item)) ++segments;
  });
  StepOptions steps = step_options(machine);
  steps.start = options.start;
  BacklashTaker path_with_rests(activity, backlash_options(steps, false));
  Planner planner(path_with_rests, motion_limits(machine));
  constexpr unsigned items_between_looks = 1024;
  MotionItem item;
  // A loop that only a probe ends goes on as far as the check has followed it.
  for (unsigned items = 1; (!check.probes || segments < check.moves) && planner.next(item); ++items) {
    const auto* move = std::get_if<PlannedMove>(&item);
    survey.watch(item);
    builder.watch(item, move != nullptr ? move->segment.work_zero : Point());
    if (path != nullptr) path->load_of_next(survey.last_load());
    if (path != nullptr) path->watch(item, move != nullptr ? move->segment.work_zero : Point());
    if (move == nullptr && std::get<Action>(item).kind == Action::Kind::tool_change) ++page.tool_changes;
    if (items % items_between_looks == 0) progress.update(activity.nominal_time() / check.nominal_time);
  }
  page.summary = builder.summary();
  page.margin = survey.verdict();
  page.knows_motors = !page.margin.axes.empty();
  return page;
}

std::string to_text(const CheckPage& page, const MachineDescription& machine) {
  const RunSummary& summary = page.summary;
  std::string text =
      fmt::format("time            {} in motion", clock_words(summary.cutting_time + summary.rapid_time));
  if (summary.dwell_time > Seconds(0)) text += fmt::format(", {} of dwells", clock_words(summary.dwell_time));
  if (page.tool_changes > 0) text += fmt::format(", and {} tool changes", page.tool_changes);
  text += "\n";
  for (const AxisSummary& axis : summary.axes) text += axis_words(axis, description_of(machine, axis.axis));
  return text + motor_words(page);
}

void add_to(nlohmann::ordered_json& json, const CheckPage& page, const MachineDescription& machine) {
  json["time_s"] = (page.summary.cutting_time + page.summary.rapid_time).value();
  json["dwell_s"] = page.summary.dwell_time.value();
  json["tool_changes"] = page.tool_changes;
  nlohmann::ordered_json axes = nlohmann::ordered_json::object();
  for (const AxisSummary& axis : page.summary.axes) {
    const AxisDescription& limits = description_of(machine, axis.axis);
    nlohmann::ordered_json own = {{"travel", {limits.travel_low, limits.travel_high}}, {"extents", nullptr}};
    if (axis.machine_extents) own["extents"] = {axis.machine_extents->low, axis.machine_extents->high};
    own["peak_speed"] = axis.peak_speed.value();
    own["peak_acceleration"] = axis.peak_acceleration.value();
    axes[std::string(1, letter_of(axis.axis))] = own;
  }
  json["axes"] = axes;
  json["margin"] = nullptr;
  if (!page.knows_motors) return;
  nlohmann::ordered_json worst = nlohmann::ordered_json::array();
  for (const MarginSpot& spot : page.margin.worst) worst.push_back(as_json(spot));
  json["margin"] = {{"verdict", name_of(page.margin.verdict)}, {"worst_lines", worst}};
}

}  // namespace passo
