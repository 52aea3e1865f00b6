#include "api_json.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/activity/machine_plant.hpp"
#include "passo/diagnostics/findings_json.hpp"

namespace passo {
namespace {

std::string axis_key(Axis axis) {
  return {static_cast<char>(letter_of(axis) - 'A' + 'a')};
}

Json names_of(const HoldReasons& holds) {
  static constexpr std::pair<HoldReason, const char*> names[] = {
      {HoldReason::operator_hold, "operator"}, {HoldReason::door, "door"},       {HoldReason::program_stop, "program"},
      {HoldReason::tool_change, "tool"},       {HoldReason::await_line, "line"}, {HoldReason::zero_feed, "zero-feed"},
      {HoldReason::probe_contact, "probe"},    {HoldReason::tap, "tap"},         {HoldReason::drop, "drop"},
      {HoldReason::line_lost, "line-lost"},    {HoldReason::stop, "stop"},       {HoldReason::line_end, "line-end"}};
  Json list = Json::array();
  for (const auto& [reason, name] : names) {
    if (holds.has(reason)) list.push_back(name);
  }
  return list;
}

// The numbers of the closed limit switches.
Json closed_limits(const MachineDescription& machine, std::uint16_t inputs) {
  Json list = Json::array();
  for (unsigned i = 0; i < machine.motor_count(); ++i) {
    if (((inputs & ~unsigned{pin_setup(machine).alarms}) >> i & input_limit) != 0) list.push_back(i);
  }
  return list;
}

// The axes whose drives give an alarm. Those that share an input are all in the list.
Json drive_alarms(const MachineDescription& machine, std::uint16_t inputs) {
  Json list = Json::array();
  for (const AxisDescription& axis : machine.axes) {
    if ((inputs & alarm_of(axis)) != 0) list.push_back(axis_key(axis.axis));
  }
  return list;
}

// The motors with their axes, in the order of the board's motors, and the levels at which its pins are on.
Json motors_json(const MachineDescription& machine) {
  Json motors = Json::array();
  const auto add = [&](const AxisDescription& axis, std::size_t motor, bool second, bool inverted, int input) {
    Json one = {{"axis", axis_key(axis.axis)}, {"second", second}, {"inverted", inverted}, {"limit", Json()}};
    if (axis.home) one["limit"] = input < 0 ? static_cast<int>(motor) : input;
    motors.push_back(std::move(one));
  };
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    const AxisDescription& axis = machine.axes[i];
    add(axis, i, false, axis.inverted, axis.home ? axis.home->input : -1);
  }
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    const AxisDescription& axis = machine.axes[i];
    if (axis.second) add(axis, machine.second_motor_of(i), true, axis.second->inverted, axis.second->input);
  }
  return motors;
}

Json pins_json(const MachineDescription& machine) {
  const PinsDescription& pins = machine.pins;
  const auto level = [](bool high) { return high ? "high" : "low"; };
  Json limits = Json::array();
  for (unsigned i = 0; i < machine.motor_count(); ++i) limits.push_back(level(pins.limits_high[i]));
  return {{"limits", std::move(limits)},
          {"probe", level(pins.probe_high)},
          {"door", level(pins.door_high)},
          {"emergency_stop", level(pins.emergency_stop_high)},
          {"hold", level(pins.feed_hold_high)},
          {"start", level(pins.cycle_start_high)},
          {"driver_enable", level(pins.driver_enable_high)},
          {"step", level(!pins.step_low)},
          {"spindle", level(!pins.spindle_low)},
          {"spindle_reverse", level(!pins.spindle_reverse_low)},
          {"mist", level(!pins.mist_low)},
          {"flood", level(!pins.flood_low)}};
}

const char* name_of(SpindleDirection direction) {
  switch (direction) {
    case SpindleDirection::clockwise: return "clockwise";
    case SpindleDirection::counterclockwise: return "counterclockwise";
    case SpindleDirection::off: break;
  }
  return "off";
}

Json waits_json(const OperatorWait& wait) {
  const bool is_tool = wait.kind == Action::Kind::tool_change;
  return {{"for", code_of(wait)},
          {"line", wait.line},
          {"tool", is_tool ? Json(wait.tool) : Json()},
          {"message", wait.words},
          {"free", false}};
}

Json abilities_json(const MachineAbilities& abilities) {
  Json all = Json::array();
  for (std::size_t i = 0; i < ability_count; ++i) {
    const auto ability = static_cast<Ability>(i);
    const Sentence* const why = abilities.why_not(ability);
    all.push_back({{"ability", name_of(ability)},
                   {"can", why == nullptr},
                   {"why", why != nullptr ? why->text : ""},
                   {"sentence", why != nullptr ? as_json(*why) : Json()}});
  }
  return all;
}

}  // namespace

double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

Json as_json(const MachineDescription& machine, const Point& place) {
  Json json = Json::object();
  for (const AxisDescription& axis : machine.axes) json[axis_key(axis.axis)] = rounded(place[axis.axis]);
  return json;
}

Json as_json(const MachineDescription& machine, const MachineStatus& status) {
  Json json = {{"change", status.version},
               {"time", rounded(status.time.value())},
               {"state", name_of(status.state)},
               {"rests", status.rests},
               {"holds", names_of(status.holds)},
               {"trust", name_of(status.position.trust)},
               {"lost_place", status.lost_place},
               {"place", as_json(machine, status.now_at)},
               {"speed", rounded(status.speed_now.value() * seconds_per_minute)},
               {"line", status.executes.line},
               {"line_to", std::max(status.executes.to, status.executes.line)},
               {"program_zero", status.executes.work_zero ? as_json(machine, *status.executes.work_zero) : Json()},
               {"board_file", status.executes.board_file.empty() ? Json() : Json(status.executes.board_file)},
               {"progress", status.progress ? Json(rounded(*status.progress)) : Json()},
               {"outputs",
                {{"spindle", name_of(status.outputs.spindle)},
                 {"spindle_speed", status.outputs.revolutions_per_minute},
                 {"mist", status.outputs.mist},
                 {"flood", status.outputs.flood}}},
               {"overrides",
                {{"feed", status.overrides.feed},
                 {"adaptive_feed", status.overrides.adaptive_feed},
                 {"rapids", status.overrides.rapids},
                 {"spindle", status.overrides.spindle}}},
               {"stops", {{"single_block", status.stops.single_block}, {"optional_stop", status.stops.optional_stop}}},
               {"inputs",
                {{"probe", (status.inputs & input_probe) != 0},
                 {"door", (status.inputs & input_door) != 0},
                 {"hold", (status.inputs & input_hold) != 0},
                 {"start", (status.inputs & input_start) != 0},
                 {"emergency_stop", (status.inputs & input_emergency_stop) != 0},
                 {"limits", closed_limits(machine, status.inputs)},
                 {"drive_alarms", drive_alarms(machine, status.inputs)}}},
               {"waits_for_tool", Json()},
               {"waits_for_operator", status.waits_for.has_value()},
               {"waits", status.waits_for ? waits_json(*status.waits_for) : Json()},
               {"measured_tool", status.measured_tool ? Json{{"tool", status.measured_tool->number},
                                                             {"length", rounded(status.measured_tool->length)}}
                                                      : Json()},
               {"trouble", status.trouble_sentence.text},
               {"trouble_sentence", as_json(status.trouble_sentence)}};
  if (status.waits_for && status.waits_for->kind == Action::Kind::tool_change) {
    json["waits_for_tool"] = status.waits_for->tool;
  }
  return json;
}

Json as_json(const HostSpindleStatus& spindle) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(rounded(*value)) : Json(); };
  return {{"answers", spindle.answers},
          {"at_speed", spindle.at_speed},
          {"speed", rounded(spindle.revolutions_per_minute)},
          {"current", number(spindle.current)},
          {"load", number(spindle.load)},
          {"fault", spindle.has_failed() ? as_json(spindle.fault) : Json()}};
}

Json as_json(const MachineControl& owner) {
  static constexpr const char* kinds[] = {"nobody", "sender", "client"};
  return {{"kind", kinds[static_cast<std::size_t>(owner.kind())]}, {"name", owner.name()}, {"taken", owner.number()}};
}

Json as_json(const PendantStatus& pendant) {
  if (pendant.name.empty()) return {};
  const auto letter = [](Axis axis) { return std::string(1, static_cast<char>(letter_of(axis) - 'A' + 'a')); };
  return {{"name", pendant.name},
          {"connected", pendant.is_connected},
          {"link", pendant.has_link},
          {"axis", pendant.axis ? Json(letter(*pendant.axis)) : Json()},
          {"continuous", pendant.is_continuous},
          {"step", rounded(pendant.step)},
          {"share", rounded(pendant.share)},
          {"missed", pendant.missed},
          {"refusal", pendant.refusal.text},
          {"refusal_sentence", as_json(pendant.refusal)}};
}

Json as_json(const ApiJob& job) {
  if (job.state == JobState::none) return Json();
  return {
      {"id", job.id},        {"program", job.program},           {"name", job.name},      {"state", name_of(job.state)},
      {"why", job.why.text}, {"why_sentence", as_json(job.why)}, {"history", job.history}};
}

Json as_json(const MachineDescription& machine, const MdiLines& mdi, const Point& at) {
  const ActiveModes modes = mdi.modes();
  Json codes = modes.codes;
  codes.push_back(modes.spindle == SpindleDirection::off         ? "M5"
                  : modes.spindle == SpindleDirection::clockwise ? "M3"
                                                                 : "M4");
  if (modes.mist) codes.push_back("M7");
  if (modes.flood) codes.push_back("M8");
  if (!modes.mist && !modes.flood) codes.push_back("M9");
  return {{"codes", std::move(codes)},
          {"feed", rounded(modes.feed)},
          {"speed", rounded(modes.speed)},
          {"tool", std::max(modes.tool, 0)},
          {"place", as_json(machine, modes.frame.work_from_machine(at))},
          {"streams", mdi.streams()},
          {"trouble", mdi.trouble()},
          {"trouble_sentence", as_json(mdi.trouble().sentence())}};
}

Json as_json(const HistoryJob& job) {
  Json waits = Json::array();
  for (const HistoryWait& wait : job.waits) {
    waits.push_back({{"at", wait.at},
                     {"for", wait.code},
                     {"line", wait.line},
                     {"tool", wait.tool ? Json(*wait.tool) : Json()},
                     {"message", wait.words}});
  }
  Json stills = Json::array();
  for (const HistoryStill& still : job.stills) {
    stills.push_back({{"id", still.id}, {"at", still.at}, {"moment", still.moment}});
  }
  return {{"id", job.id},
          {"attempt", job.attempt.empty() ? Json() : Json(job.attempt)},
          {"name", job.name},
          {"dialect", job.dialect},
          {"bytes", job.bytes},
          {"state", name_of(job.state)},
          {"why", job.why},
          {"why_sentence", sentence_json(job.why_sentence, job.why)},
          {"queued_at", job.queued_at},
          {"begun_at", job.begun_at},
          {"ended_at", job.ended_at},
          {"waits", std::move(waits)},
          {"stills", std::move(stills)}};
}

// With the text: words that an older program has written since are not those of the sentence.
std::string kept_form(const Sentence& sentence) {
  Json json = as_json(sentence);
  json["text"] = sentence.text;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json sentence_json(const std::string& kept, const std::string& words) {
  Json json = Json::parse(kept, nullptr, false);
  if (!json.is_object() || !json.contains("text") || json["text"] != words) return Json();
  json.erase("text");
  return json;
}

Json as_json(const std::vector<HomedAxis>& homed, const HomingRepeats& repeats) {
  Json axes = Json::array();
  for (const HomedAxis& one : homed) {
    axes.push_back({{"axis", axis_key(one.axis)},
                    {"way", rounded(one.way)},
                    {"place", rounded(one.place)},
                    {"squared", one.squared ? Json(rounded(*one.squared)) : Json()}});
  }
  Json all = Json::array();
  for (const AxisRepeats& one : repeats.axes()) {
    all.push_back({{"axis", axis_key(one.axis)},
                   {"homings", one.homings},
                   {"last", rounded(one.last / 1000)},
                   {"mean", rounded(one.mean / 1000)},
                   {"spread", rounded(one.spread / 1000)},
                   {"spread_steps", one.spread_steps}});
  }
  return {{"axes", std::move(axes)}, {"repeats", std::move(all)}};
}

Json as_json(const MachineDescription& machine, const WayBack& way) {
  const Sentence why = way ? Sentence() : way.error();
  Json steps = Json::array();
  Json sentences = Json::array();
  for (const Sentence& one : way ? way->steps : std::vector<Sentence>()) {
    steps.push_back(one.text);
    sentences.push_back(as_json(one));
  }
  return {{"line", way ? Json(way->at.line) : Json()},
          {"place", way ? as_json(machine, way->at.point) : Json()},
          {"steps", std::move(steps)},
          {"step_sentences", std::move(sentences)},
          {"code", why.code},
          {"why", why.text},
          {"why_sentence", as_json(why)}};
}

// The counts of the motors from machine zero, of the axes by name.
Json as_json(const MachineDescription& machine, const InterruptedJob& job, const WayBack& way) {
  Json steps = Json::object();
  const ResumePoint* const point = job.point ? &*job.point : nullptr;
  for (std::size_t m = 0; point != nullptr && m < machine.axes.size(); ++m) {
    steps[axis_key(machine.axes[m].axis)] = point->steps[m];
  }
  return {{"job", as_json(job.job)},
          {"noted_at", job.journal.noted_at},
          {"line", point != nullptr ? Json(point->line) : Json()},
          {"place", point != nullptr ? as_json(machine, point->point) : Json()},
          {"steps", std::move(steps)},
          {"goes_on", job.why.code.empty()},
          {"code", job.why.code},
          {"why", job.why.text},
          {"why_sentence", as_json(job.why)},
          {"reentry", as_json(machine, way)}};
}

Json as_json(const Diagnostics& findings) {
  Json list = findings_json(findings.all());
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const char* const left_out : {"file", "length", "rule", "calls"}) list[i].erase(left_out);
    list[i]["message_sentence"] = as_json(findings.all()[i].message.sentence());
    list[i]["expected_sentence"] = as_json(findings.all()[i].expected.sentence());
  }
  return list;
}

Json as_json(const StoredProgram& program, bool with_findings) {
  Json json = {{"id", program.id},
               {"name", program.name},
               {"dialect", dialect_name(program.dialect)},
               {"bytes", program.text.size()},
               {"lines", program.lines},
               {"state", name_of(program.state)},
               {"checks", program.checks},
               {"seconds", rounded(program.check.nominal_time.value())},
               {"planned", program.planned_time ? Json(rounded(program.planned_time->value())) : Json()},
               {"moves", program.check.moves},
               {"block_delete", program.block_delete},
               {"deleted_lines", program.deleted_lines},
               {"small", program.is_small},
               {"height_map", program.height_map.has_value()}};
  if (with_findings) json["findings"] = as_json(program.findings);
  return json;
}

namespace {

Json camera_json(const CameraDescription* camera) {
  if (camera == nullptr) return {};
  return {{"offset", {{"x", camera->offset_x.value()}, {"y", camera->offset_y.value()}}},
          {"rotation", camera->rotation},
          {"mirrored", camera->is_mirrored}};
}

Json park_json(const ParkDescription& park) {
  if (!park.place) return {};
  return {{"x", (*park.place)[Axis::x]}, {"y", (*park.place)[Axis::y]}};
}

Json handwheel_json(const HandwheelDescription& wheel) {
  Json axes = Json::array();
  for (const auto& axis : wheel.axes) axes.push_back(axis ? Json(axis_key(*axis)) : Json());
  return {{"axes", std::move(axes)},
          {"counts_per_detent", wheel.counts_per_detent},
          {"step", wheel.step},
          {"share", wheel.share},
          {"reversed", wheel.is_reversed}};
}

}  // namespace

Json as_json(const CameraStatus& camera) {
  constexpr const char* states[] = {"off", "connecting", "live", "waiting"};  // in the order of State
  return {{"state", states[static_cast<std::size_t>(camera.state)]},
          {"age", camera.age ? Json(rounded(camera.age->value())) : Json()},
          {"problem", camera.problem.text},
          {"problem_sentence", as_json(camera.problem)}};
}

Json machine_json(const MachineDescription& machine, const MachineAbilities& abilities, std::string_view version,
                  const CameraDescription* camera) {
  Json axes = Json::array();
  for (const AxisDescription& axis : machine.axes) {
    axes.push_back({{"axis", axis_key(axis.axis)},
                    {"low", axis.travel_low},
                    {"high", axis.travel_high},
                    {"speed", axis.velocity.value() * seconds_per_minute},
                    {"acceleration", axis.acceleration.value()},
                    {"steps_per_unit", axis.steps_per_unit},
                    {"homes", axis.home.has_value()}});
  }
  return {{"name", machine.name},
          {"version", version},
          {"axes", std::move(axes)},
          {"motors", motors_json(machine)},
          {"pins", pins_json(machine)},
          {"highest_rpm", machine.tool.highest_rpm},
          {"top", machine.top_of_travel() ? Json(*machine.top_of_travel()) : Json()},
          {"park", park_json(machine.park)},
          {"camera", camera_json(camera)},
          {"handwheel", machine.handwheel ? handwheel_json(*machine.handwheel) : Json()},
          {"abilities", abilities_json(abilities)}};
}

}  // namespace passo
