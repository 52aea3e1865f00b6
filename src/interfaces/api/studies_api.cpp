#include "studies_api.hpp"

#include <charconv>
#include <utility>

#include "api_json.hpp"
#include "cam_schema.hpp"

#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/tool_table_file.hpp"
#include "passo/operations/study_arguments.hpp"

namespace passo {
namespace {

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

// A text that is no number is refused here: no person is typing it. Null: it is no number.
Json number_of(const Json& value) {
  if (!value.is_string()) return value;
  const auto& text = value.get_ref<const std::string&>();
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? Json(number) : Json();
}

WebAnswer file_answer(const char* type, std::string text) {
  if (text.empty()) return error_answer(404, "http.not-found", "the last study has none");
  return {.type = type, .body = std::move(text)};
}

}  // namespace

WebAnswer StudiesApi::state_answer(unsigned status) const {
  const StudyResult& result = shared_.options.studies->result();
  const Json report = Json::parse(result.report, nullptr, false);
  return json_answer(status, {{"study", study_},
                              {"program", studied_ != 0 ? Json(studied_) : Json()},
                              {"state", name_of(result.state)},
                              {"words", result.words},
                              {"report", report.is_object() ? report : Json()}});
}

WebAnswer StudiesApi::get(const ApiCall&) {
  return state_answer(200);
}

WebAnswer StudiesApi::loads(const ApiCall&) {
  return file_answer("text/csv", is_done() ? shared_.options.studies->loads() : "");
}

WebAnswer StudiesApi::picture(const ApiCall&) {
  return file_answer("image/svg+xml", is_done() ? shared_.options.studies->picture() : "");
}

WebAnswer StudiesApi::options(const ApiCall&) {
  return json_answer(200, {{"tune", schema_of(tune_study())}});
}

WebAnswer StudiesApi::begin(const ApiCall& call) {
  const Json& said = call.body;
  if (!said.is_object()) return bad_body("the body is not a JSON object");
  StudyOrder order;
  const std::vector<CamOption> rows = tune_study().options();
  for (const auto& [name, value] : said.items()) {
    if (name == "study" || name == "program" || name == "machine") continue;
    const CamOption* const row = find_ordered(rows, name);
    if (row == nullptr) return bad_body("there is no \"" + name.substr(0, 40) + "\"");
    const auto texts = ordered_values(*row, is_number(row->kind) ? number_of(value) : value, {});
    if (!texts) return bad_body(texts.error());
    for (const std::string& text : *texts) order.options.push_back("--" + name + (text.empty() ? "" : "=" + text));
  }
  if (shared_.options.studies == nullptr) return no_studies();
  const Json study = said.value("study", Json());
  if (study != "motors" && study != "tune") return bad_body("\"study\": expected motors or tune");
  order.kind = study == "tune" ? StudyOrder::Kind::tune : StudyOrder::Kind::motors;
  const Json machine = said.value("machine", Json());
  const MachineFileAccess& file = shared_.options.machine_access;
  if (machine.is_string()) {
    order.machine = machine.get<std::string>();
  } else if (machine.is_null() && file.read) {
    order.machine = file.read().value_or("");
  }
  if (order.machine.empty() || order.machine.size() > longest_machine) {
    return bad_body("\"machine\": expected the text of a machine file");
  }
  std::uint64_t id = 0;
  if (order.kind == StudyOrder::Kind::motors) {
    const Json wanted = said.value("program", Json());
    if (!wanted.is_number_unsigned()) return bad_body("\"program\": expected the number of a program");
    id = wanted.get<std::uint64_t>();
    const StoredProgram* const program = shared_.programs.find(id);
    if (program == nullptr) return refusal_answer(404);
    order.program = program->text_to_keep();
    order.dialect = dialect_name(program->dialect);
    order.parameters = parameter_file_text(shared_.programs.parameters());
    // Where nobody has given a table, no tool is missing.
    if (!shared_.programs.tools().name.empty()) order.tools = tool_table_text(shared_.programs.tools());
  }
  if (!shared_.options.studies->begin(order)) return error_answer(409, "study.busy", "no study can start now");
  study_ = study.get<std::string>();
  studied_ = id;
  return state_answer(202);
}

}  // namespace passo
