// MachineApi: what is worked out beside the machine: the torque that a program needs, and limits for the motors.
#include <utility>

#include "api_json.hpp"

namespace passo {
namespace {

constexpr double least_margin = 0.1;
constexpr double most_margin = 0.9;
constexpr std::size_t longest_machine = std::size_t{1} << 20;  // bytes

const char* name_of(StudyResult::State state) {
  switch (state) {
    case StudyResult::State::none: return "none";
    case StudyResult::State::running: return "running";
    case StudyResult::State::done: return "done";
    case StudyResult::State::failed: return "failed";
  }
  return "";
}

WebAnswer no_studies() {
  return error_answer(404, "study.none", "this server makes no studies");
}

}  // namespace

WebAnswer MachineApi::study_answer() {
  if (options_.studies == nullptr) return no_studies();
  const StudyResult& result = options_.studies->look();
  const Json report = Json::parse(result.report, nullptr, false);
  return json_answer(200, {{"study", study_},
                           {"program", studied_ != 0 ? Json(studied_) : Json()},
                           {"state", name_of(result.state)},
                           {"words", result.words},
                           {"report", report.is_object() ? report : Json()}});
}

WebAnswer MachineApi::study_file(bool picture) const {
  if (options_.studies == nullptr) return no_studies();
  const bool done = options_.studies->look().state == StudyResult::State::done;
  std::string text = !done ? "" : picture ? options_.studies->picture() : options_.studies->loads();
  if (text.empty()) return error_answer(404, "http.not-found", "the last study has none");
  return {.type = picture ? "image/svg+xml" : "text/csv", .body = std::move(text)};
}

WebAnswer MachineApi::begin_study(std::string_view body) {
  const Json said = Json::parse(body, nullptr, false);
  if (!said.is_object()) return bad_body("the body is no JSON object");
  for (const auto& [name, value] : said.items()) {
    if (name != "study" && name != "program" && name != "machine" && name != "margin") {
      return bad_body("there is no \"" + name.substr(0, 40) + "\"");
    }
  }
  if (options_.studies == nullptr) return no_studies();
  const Json study = said.value("study", Json());
  if (study != "motors" && study != "tune") return bad_body("\"study\": expected motors or tune");
  StudyOrder order;
  order.kind = study == "tune" ? StudyOrder::Kind::tune : StudyOrder::Kind::motors;
  const Json machine = said.value("machine", Json());
  if (machine.is_string()) {
    order.machine = machine.get<std::string>();
  } else if (machine.is_null() && options_.machine_access.read) {
    order.machine = options_.machine_access.read().value_or("");
  }
  if (order.machine.empty() || order.machine.size() > longest_machine) {
    return bad_body("\"machine\": expected the text of a machine file");
  }
  const Json margin = said.value("margin", Json(order.margin));
  if (!margin.is_number() || !(margin >= least_margin && margin <= most_margin)) {
    return bad_body("\"margin\": expected 0.1 to 0.9");
  }
  order.margin = margin.get<double>();
  std::uint64_t id = 0;
  if (order.kind == StudyOrder::Kind::motors) {
    const Json wanted = said.value("program", Json());
    if (!wanted.is_number_unsigned()) return bad_body("\"program\": expected the number of a program");
    id = wanted.get<std::uint64_t>();
    const StoredProgram* const program = programs_.find(id);
    if (program == nullptr) return refusal(404);
    order.program = program->text_to_keep();
    order.dialect = program->dialect == Dialect::grbl ? "grbl" : "linuxcnc";
    order.parameters = parameter_file_text(programs_.parameters());
  }
  if (!options_.studies->begin(order)) return error_answer(409, "study.busy", "no study can begin now");
  study_ = study.get<std::string>();
  studied_ = id;
  WebAnswer answer = study_answer();
  answer.status = 202;
  return answer;
}

}  // namespace passo
