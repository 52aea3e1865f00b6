#include "passo/judge/check_page.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/diagnostics/findings_json.hpp"
#include "passo/judge/link_delay_words.hpp"
#include "passo/verdict/margin_words.hpp"

namespace passo {

std::string clock_words(Seconds time) {
  const auto seconds = static_cast<long long>(std::llround(time.value()));
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

const AxisDescription& description_of(const MachineDescription& machine, Axis axis) {
  return *std::ranges::find(machine.axes, axis, &AxisDescription::axis);
}

std::string limit_words(const SpeedShare& share) {
  std::string words = describe(share.bound);
  if (!(share.limit > 0)) return words;
  const char* const unit = is_rotary(share.bound.axis) ? "deg" : "mm";
  const bool velocity = share.bound.kind == SpeedBound::Kind::velocity;
  const bool jerk = share.bound.kind == SpeedBound::Kind::jerk;
  return words + fmt::format(", {} {}/s{}", sensible_number(share.limit, 4), unit,
                             velocity ? ""
                             : jerk   ? "\u00B3"
                                      : "\u00B2");
}

std::string feed_words(const WorkSummary& work, const RunSummary& summary) {
  const auto rounded = [](double value) { return std::round(value * 1000) / 1000 + 0.0; };  // no -0
  std::string words;
  for (std::size_t i = 0; i < summary.axes.size(); ++i) {
    if (!work.cutting[i]) continue;
    const Axis axis = summary.axes[i].axis;
    words += fmt::format("{}{} {:.3f} to {:.3f} {}", words.empty() ? "" : ", ", letter_of(axis),
                         rounded(work.cutting[i]->low), rounded(work.cutting[i]->high), is_rotary(axis) ? "deg" : "mm");
  }
  return words;
}

namespace {

std::string axis_words(const AxisSummary& moved, const AxisDescription& axis) {
  const char* unit = is_rotary(axis.axis) ? "deg" : "mm";
  std::string words = fmt::format("axis {}          ", letter_of(axis.axis));
  if (!moved.machine_extents) return words + "does not move\n";
  return words + fmt::format("{:.3f} to {:.3f} {unit} of {:g} to {:g}; {} {unit}/s of {:g}, {} {unit}/s2 of {}\n",
                             moved.machine_extents->low, moved.machine_extents->high, axis.travel_low, axis.travel_high,
                             sensible_number(moved.peak_speed.value(), 4), axis.velocity.value(),
                             sensible_number(moved.peak_acceleration.value(), 4),
                             sensible_number(axis.acceleration.value(), 4), fmt::arg("unit", unit));
}

}  // namespace

// The axes whose limits are reached, and for how much of the time. The motion's bounds with less than half a percent of
// the time are left out.
std::string speed_words(const SpeedReport& speed, Seconds whole) {
  if (!(whole > Seconds(0))) return "";
  std::string words = "speed limits    % of the motion time\n";
  constexpr std::size_t most_shares = 6;
  std::size_t shown = 0;
  for (const SpeedShare& share : speed.shares) {
    const double percent = 100 * (share.time / whole);
    if (percent < 0.5 || ++shown > most_shares) break;
    words += fmt::format("  {:3.0f} %         {}; first in line {}\n", percent, limit_words(share), share.first_line);
  }
  constexpr std::size_t most_parts = 3;
  const auto add = [&words](const char* what, const SpeedPart& part) {
    words +=
        fmt::format("  {}       line {}: {:.4g} {}/s", what, part.line,
                    part.lost > Seconds(0) ? part.mean().value() : part.highest.value(), part.turns ? "deg" : "mm");
    if (part.rapid) words += ", a rapid";
    if (part.lost > Seconds(0)) {
      words += fmt::format(" of {:.4g}, {:.2g} s lost", part.programmed.value(), part.lost.value());
    }
    words += fmt::format("; {}\n", describe(part.bound));
  };
  for (std::size_t i = 0; i < std::min(most_parts, speed.slowest.size()); ++i) {
    if (speed.slowest[i].is_slow()) add("slowest", speed.slowest[i]);
  }
  std::size_t feeds = 0;
  for (SpeedPart part : speed.fastest) {
    part.lost = Seconds(0);
    if (part.rapid || ++feeds <= most_parts) add("fastest", part);
  }
  return words;
}

namespace {

std::string motor_words(const Judgement& page) {
  if (!page.knows_motors) return "";
  std::string words = fmt::format("motors          {}", name_of(page.margin.verdict));
  if (page.margin.verdict == Verdict::safe) words += ": enough torque, even if the motors are weak";
  if (page.margin.verdict == Verdict::doubtful) words += ": weak motors may lose steps";
  if (page.margin.verdict == Verdict::lost) words += ": they lose steps";
  if (page.margin.verdict != Verdict::safe && is_torque_enough(page.margin)) {
    words += ", because of resonance; the torque alone would be enough";
  }
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

const char* name_of(SpeedBound::Kind kind) {
  const char* const names[] = {"feed", "velocity", "acceleration", "bending", "torque", "jerk", "none"};
  return names[static_cast<std::size_t>(kind)];
}

// The axis is null where no axis bounds the speed.
nlohmann::ordered_json as_json(const SpeedBound& bound) {
  const bool of_axis = bound.kind != SpeedBound::Kind::feed && bound.kind != SpeedBound::Kind::passage;
  nlohmann::ordered_json json = {{"limit", name_of(bound.kind)}, {"axis", nullptr}};
  if (of_axis) json["axis"] = std::string(1, letter_of(bound.axis));
  return json;
}

nlohmann::ordered_json as_json(const std::vector<SpeedPart>& parts) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SpeedPart& part : parts) {
    nlohmann::ordered_json json = {{"line", part.line},
                                   {"rapid", part.rapid},
                                   {"unit", part.turns ? "deg" : "mm"},
                                   {"way_mm", part.way.value()},
                                   {"time_s", part.time.value()},
                                   {"lost_s", part.lost.value()},
                                   {"mean_mm_s", part.mean().value()},
                                   {"highest_mm_s", part.highest.value()},
                                   {"programmed_mm_s", nullptr}};
    if (!part.rapid) json["programmed_mm_s"] = part.programmed.value();
    json.update(as_json(part.bound));
    list.push_back(json);
  }
  return list;
}

}  // namespace

nlohmann::ordered_json as_json(const SpeedReport& speed) {
  nlohmann::ordered_json bounds = nlohmann::ordered_json::array();
  for (const SpeedShare& share : speed.shares) {
    nlohmann::ordered_json json = as_json(share.bound);
    json["time_s"] = share.time.value();
    json["first_line"] = share.first_line;
    if (share.limit > 0) json["value"] = share.limit;
    bounds.push_back(json);
  }
  return {{"bounds", bounds}, {"slowest", as_json(speed.slowest)}, {"fastest", as_json(speed.fastest)}};
}

namespace {

nlohmann::ordered_json as_json(const MarginSpot& spot) {
  const char* const wants[] = {"torque", "jump", "calm"};
  nlohmann::ordered_json json = {{"line", spot.line},
                                 {"axis", std::string(1, letter_of(spot.axis))},
                                 {"verdict", name_of(spot.verdict)},
                                 {"want", wants[static_cast<std::size_t>(spot.want)]},
                                 {"time_s", spot.time.value()},
                                 {"needed_nm", spot.needed.value},
                                 {"cut_nm", spot.of_cut.value},
                                 {"low_nm", spot.there.low.value},
                                 {"high_nm", spot.there.high.value},
                                 {"full_steps_s", spot.rate.value()},
                                 {"acceleration", spot.acceleration.value()},
                                 {"cause", cause_of(spot)}};
  if (spot.safe_acceleration) json["safe_acceleration"] = spot.safe_acceleration->value();
  if (spot.safe_path_speed) {
    json["safe_feed_mm_min"] = 60 * spot.safe_path_speed->value();
    // A rapid is slowed by the velocity of its axis.
    if (spot.rapid) json["safe_velocity_mm_min"] = 60 * (*spot.safe_path_speed / spot.path_speed * spot.speed.value());
  }
  if (spot.verdict != Verdict::safe) json["cure"] = cure_of(spot);
  return json;
}

nlohmann::ordered_json work_json(const RunSummary& summary) {
  nlohmann::ordered_json systems = nlohmann::ordered_json::object();
  for (const WorkSummary& work : summary.work) {
    nlohmann::ordered_json axes = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < summary.axes.size(); ++i) {
      if (!work.cutting[i]) continue;
      axes[std::string(1, letter_of(summary.axes[i].axis))] = {work.cutting[i]->low, work.cutting[i]->high};
    }
    systems[name_of_system(work.system)] = axes;
  }
  return systems;
}

}  // namespace

nlohmann::ordered_json findings_as_json(const Diagnostics& findings, const ProgramStops& stops) {
  nlohmann::ordered_json waits = nlohmann::ordered_json::array();
  for (const OperatorWait& stop : stops.first()) {
    waits.push_back({{"line", stop.line}, {"for", code_of(stop)}});
    if (stop.kind == Action::Kind::tool_change) waits.back()["tool"] = stop.tool;
    if (!stop.words.empty()) waits.back()["message"] = stop.words;
  }
  return {{"good", !findings.any_error()},
          {"errors", findings.errors()},
          {"findings", findings_json(findings.all())},
          {"waits", stops.count()},
          {"waits_first_at", waits}};
}

std::string to_text(const Judgement& page, const MachineDescription& machine) {
  const RunSummary& summary = page.summary;
  std::string text =
      fmt::format("time            {} in motion", clock_words(summary.cutting_time + summary.rapid_time));
  if (summary.dwell_time > Seconds(0)) text += fmt::format(", {} of dwells", clock_words(summary.dwell_time));
  if (page.tool_changes > 0) text += ", and " + counted(page.tool_changes, "tool change");
  text += "\n";
  if (page.line) text += to_text(*page.line);
  for (const AxisSummary& axis : summary.axes) text += axis_words(axis, description_of(machine, axis.axis));
  for (const WorkSummary& work : summary.work) {
    const std::string feeds = feed_words(work, summary);
    if (!feeds.empty()) text += fmt::format("{:16}{} at feed\n", name_of_system(work.system), feeds);
  }
  return text + speed_words(page.speed, summary.cutting_time + summary.rapid_time) + motor_words(page);
}

void add_to(nlohmann::ordered_json& json, const Judgement& page, const MachineDescription& machine) {
  json["time_s"] = (page.summary.cutting_time + page.summary.rapid_time).value();
  json["dwell_s"] = page.summary.dwell_time.value();
  json["tool_changes"] = page.tool_changes;
  json["line"] = page.line ? as_json(*page.line) : nlohmann::ordered_json();
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
  json["work"] = work_json(page.summary);
  json["speed"] = as_json(page.speed);
  json["margin"] = nullptr;
  if (!page.knows_motors) return;
  nlohmann::ordered_json worst = nlohmann::ordered_json::array();
  for (const MarginSpot& spot : page.margin.worst) worst.push_back(as_json(spot));
  json["margin"] = {{"verdict", name_of(page.margin.verdict)}, {"worst_lines", worst}};
}

}  // namespace passo
