#include "small_jobs_api.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "api_json.hpp"
#include "json_members.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/activity/framing.hpp"
#include "passo/activity/go_to.hpp"

namespace passo {
namespace {

// The text member, removed from the body, so that the others are numbers and flags. Empty: there is none.
std::optional<std::string> take_text(Json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_string()) return {};
  std::string text = found->get<std::string>();
  body.erase(key);
  return text;
}

Json as_json(const Macro& macro) {
  Json values = Json::array();
  for (const MacroValue& one : macro.values) {
    values.push_back({{"name", one.name},
                      {"title", one.title},
                      {"unit", one.unit},
                      {"low", one.low},
                      {"high", one.high},
                      {"whole", one.is_whole},
                      {"default", one.usual ? Json(*one.usual) : Json()}});
  }
  return {{"name", macro.name},
          {"title", macro.title},
          {"key", macro.key},
          {"input", macro.input},
          {"values", std::move(values)}};
}

// Empty: the body has something other than numbers.
std::optional<MacroValues> macro_values(const Json& body) {
  if (!body.is_object()) return {};
  MacroValues values;
  for (const auto& [name, value] : body.items()) {
    if (!value.is_number()) return {};
    values[name] = value.get<double>();
  }
  return values;
}

// A frame at an unset work zero does not show where the job will be cut.
bool is_unset(const Frame& frame) {
  const auto is_zero = [&](Axis axis) { return frame.work_offset()[axis] == 0; };
  return is_zero(Axis::x) && is_zero(Axis::y) && is_zero(Axis::z) && frame.rotation_degrees() == 0;
}

}  // namespace

std::optional<WebAnswer> SmallJobsApi::refuse() const {
  const MachineStatus status = shared_.session.status();
  if (status.state != MachineState::idle || jobs_.is_checking()) return not_idle(status.state);
  if (const auto refused = shared_.session.lost_place()) return refused_answer(*refused);
  if (status.position.trust != Trust::unknown) return {};
  return error_answer(409, "goto.place-unknown",
                      "the machine position is unknown: home the machine, or confirm its position");
}

WebAnswer SmallJobsApi::frame(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  Json body = call.members();
  Framing framing;
  if (body.contains("shape")) {
    const auto shape = take_text(body, "shape");
    if (shape != "extents" && shape != "hull") return bad_body("shape: expected extents or hull");
    framing.hull = shape == "hull";
  }
  JsonMembers members(std::move(body));
  for (const FramingField& field : framing_fields()) framing.*field.value = members.number(std::string(field.name));
  const bool accepts_zero = members.flag("machine_zero").value_or(false);
  if (!members.end()) return bad_body(members.reason());
  jobs_.step_aside();
  if (auto refused = refuse()) return std::move(*refused);
  if (program->state != UploadState::good) {
    return error_answer(409, "framing.unchecked",
                        "the program has not been checked from here, or has errors: check it first");
  }
  if (!accepts_zero && is_unset(shared_.programs.work_frame())) {
    return error_answer(409, "framing.no-zero",
                        "the work zero is not set, so the job lies at machine zero: set the work zero first");
  }
  auto text = framing_program(program->outline, framing, shared_.machine, program->name);
  if (!text) return error_answer(409, text.error().code, text.error());
  return run("frame " + program->name, std::move(*text));
}

WebAnswer SmallJobsApi::go_to(const ApiCall& call) {
  Json body = call.members();
  const auto name = take_text(body, "to");
  if (name == "cross_hair" && body.empty()) return go_to_cross_hair();
  const auto destination = name ? destination_named(*name) : std::nullopt;
  if (!destination || !body.empty()) {
    std::vector<std::string_view> known;
    for (const Destination one : all_destinations()) known.push_back(name_of(one));
    known.emplace_back("cross_hair");
    return bad_body(fmt::format("expected {{\"to\": …}} with one of {}", fmt::join(known, ", ")));
  }
  jobs_.step_aside();
  if (auto refused = refuse()) return std::move(*refused);
  const ProgramStore& programs = shared_.programs;
  auto text = go_to_program(*destination, shared_.machine, programs.parameters(), programs.work_frame());
  if (!text) return error_answer(409, text.error().code, text.error());
  return run("go to " + std::string(name_of(*destination)), std::move(*text));
}

WebAnswer SmallJobsApi::go_to_cross_hair() {
  if (!shared_.camera) return no_camera();
  jobs_.step_aside();
  if (auto refused = refuse()) return std::move(*refused);
  const Point place = under_cross_hair(shared_.camera->description, shared_.session.status().position.place);
  auto text = go_over_program(place, shared_.machine);
  if (!text) return error_answer(409, text.error().code, text.error());
  return run("go to the cross-hair", std::move(*text));
}

const MacroFolder& SmallJobsApi::macros() {
  const std::string& folder = shared_.options.macro_folder;
  const bool may_read = !has_read_macros_ || !shared_.session.busy();
  if (!folder.empty() && may_read) macros_ = read_macro_folder(folder);
  has_read_macros_ = true;
  return macros_;
}

WebAnswer SmallJobsApi::list_macros(const ApiCall&) {
  Json list = Json::array();
  for (const Macro& one : macros().macros) list.push_back(as_json(one));
  const Json refused = refused_macro_.empty() ? Json() : Json({{"name", refused_macro_}, {"error", refusal_}});
  return json_answer(200, {{"macros", std::move(list)}, {"findings", as_json(macros_.findings)}, {"refused", refused}});
}

WebAnswer SmallJobsApi::run_macro(const ApiCall& call) {
  Json body = call.members();
  const auto name = take_text(body, "name");
  if (!name) return bad_body("expected {\"name\": …, \"values\": {…}}");
  const auto values = macro_values(body.value("values", Json::object()));
  body.erase("values");
  if (!values || !body.empty()) return bad_body("values: expected an object with a number for each value");
  jobs_.step_aside();
  if (auto refused = refuse()) return std::move(*refused);
  const auto& all = macros().macros;
  const auto macro = std::ranges::find(all, *name, &Macro::name);
  if (macro == all.end()) return error_answer(404, "macro.none", "there is no macro of this name");
  return run(*macro, *values);
}

WebAnswer SmallJobsApi::run(const Macro& macro, const MacroValues& values) {
  auto text = macro_program(macro, values);
  if (!text) return error_answer(409, text.error().code, text.error());
  return run("macro " + macro.name, std::move(*text));
}

// A button has a meaning of its own in a hold, and while a job waits for the operator. An alarm of a drive is no
// button.
void SmallJobsApi::poll() {
  const Seconds now = shared_.session.now();
  if (shared_.options.macro_folder.empty() || now - looked_at_ < between_looks) return;
  looked_at_ = now;
  const MachineStatus status = shared_.session.status();
  if (status.state == MachineState::offline || status.state == MachineState::fault) return buttons_.forget();
  const std::uint16_t pressed = buttons_.update(status.inputs, now);
  if (pressed == 0 || status.state != MachineState::idle || jobs_.is_checking() || jobs_.parked()) return;
  const auto is_alarm = [&](int input) {
    return std::ranges::any_of(shared_.machine.axes,
                               [&](const AxisDescription& axis) { return axis.alarm_input == input; });
  };
  if ((pressed & input_start) != 0 && !is_alarm(alarm_at_cycle_start)) return start_macro_of("cycle_start");
  if ((pressed & input_hold) != 0 && !is_alarm(alarm_at_feed_hold)) start_macro_of("feed_hold");
}

void SmallJobsApi::start_macro_of(std::string_view input) {
  const auto& all = macros().macros;
  const auto macro = std::ranges::find(all, input, &Macro::input);
  if (macro == all.end()) return;
  auto refused = refuse();
  const WebAnswer answer = refused ? std::move(*refused) : run(*macro, {});
  const bool is_started = answer.status == 202;
  refused_macro_ = is_started ? std::string() : macro->name;
  refusal_ = is_started ? Json() : Json::parse(answer.body, nullptr, false).value("error", Json());
}

WebAnswer SmallJobsApi::run(std::string name, std::string text) {
  ProgramStore& programs = shared_.programs;
  const StoredProgram* const before = programs.find(last_);
  if (before != nullptr && !jobs_.runs(*before) && !jobs_.waits_with(last_)) programs.remove(last_);
  const StoredProgram* const program = programs.add_small(std::move(name), std::move(text));
  if (program == nullptr) return no_room();
  last_ = program->id;
  WebAnswer answer = jobs_.begin(*program, {});
  if (answer.status != 202) programs.remove(last_);
  return answer;
}

}  // namespace passo
