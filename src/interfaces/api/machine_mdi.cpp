// MachineApi: lines that a person types.
#include <utility>

#include "api_json.hpp"

#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

// The only member of the body.
std::optional<std::string> read_line(const Json& body) {
  const auto line = body.is_object() && body.size() == 1 ? body.find("line") : body.end();
  if (line == body.end() || !line->is_string()) return {};
  return line->get<std::string>();
}

}  // namespace

WebAnswer MachineApi::take_mdi(std::string_view text) {
  const auto line = read_line(Json::parse(text, nullptr, false));
  if (!line) return bad_body("expected {\"line\": \"G0 X1\"}");
  if (!line->starts_with("$")) step_aside();
  if (job_.state == JobState::checking) return error_answer(409, "machine.busy", "a job is about to begin");
  if (kept_ && kept_->interrupted() != nullptr && !line->starts_with("$")) {
    return error_answer(409, "jobs.interrupted", "a job was broken off: resume it or drop it first");
  }
  MdiLines::Answer answer = mdi_.take(*line);
  if (!answer.code.empty()) {
    const Json error = {{"code", answer.code}, {"message", answer.message}, {"expected", answer.expected}};
    return json_answer(409, {{"error", error}});
  }
  return json_answer(200, {{"words", std::move(answer.words)}, {"change", session_.status().version}});
}

// One set of offsets and tools for lines and programs. Whoever owns the motion no longer leaves nothing on.
void MachineApi::mind_mdi() {
  if (mdi_.turn()) {
    SavedParameters parameters = mdi_.parameters();
    parameters[work_system_parameter] = 1;  // programs begin with G54
    keep_results(parameters, mdi_.tools());
  }
  if (std::exchange(mdi_owner_, owner_.changes()) == owner_.changes() || owner_.kind() == MotionOwner::Kind::client) {
    return;
  }
  if (mdi_.streams()) static_cast<void>(session_.request(request::Stop{}).has_value());
  if (owner_.is_sender()) mdi_.begin_anew();
}

Json as_json(const MachineDescription& machine, const MdiLines& mdi, const Point& at) {
  const ModesInForce modes = mdi.modes();
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
          {"trouble", mdi.trouble()}};
}

}  // namespace passo
