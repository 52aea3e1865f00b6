#include "cam_api.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "api_json.hpp"
#include "cam_schema.hpp"
#include "part_job_draft.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_options = 60;
constexpr std::size_t most_values = 200;

const char* name_of(CamResult::State state) {
  switch (state) {
    case CamResult::State::none: return "none";
    case CamResult::State::running: return "running";
    case CamResult::State::done: return "done";
    case CamResult::State::failed: return "failed";
  }
  return "";
}

template <class List>
bool has(const List& list, std::string_view one) {
  return std::ranges::find(list, one) != std::ranges::end(list);
}

struct MakeOption {
  std::string name;
  std::optional<std::string> value;  // empty: a flag
};

// The error: the options are none.
Result<std::vector<MakeOption>, std::string> options_of(const CamOperation& operation, const Json& json,
                                                        const std::vector<std::string>& files) {
  std::vector<MakeOption> all;
  if (!json.is_object() || json.size() > most_options) return Failure{"\"options\": expected an object"};
  const std::vector<CamOption> rows = operation.options();
  for (const auto& [name, value] : json.items()) {
    const CamOption* const row = find_ordered(rows, name);
    if (row == nullptr) return Failure{fmt::format("{} has no option \"{}\"", operation.name, name.substr(0, 40))};
    const auto texts = ordered_values(*row, value, files);
    if (!texts) return Failure{texts.error()};
    for (const std::string& text : *texts) {
      if (all.size() >= most_values) return Failure{fmt::format("\"{}\": there are too many values", name)};
      all.push_back({name, row->kind == CamKind::flag ? std::nullopt : std::optional(text)});
    }
  }
  return all;
}

// As lines of a profile (machine_file/option_profile.hpp). The error: there is no such profile.
Result<std::string, std::string> profile_of(const CamOperation& operation, const Json& json,
                                            const std::vector<std::string>& files) {
  std::string text;
  if (!json.is_object()) return Failure{"\"profile\": expected an object"};
  for (const auto& [table, values] : json.items()) {
    if (!has(operation.parts, table)) {
      return Failure{fmt::format("\"profile\": there is no table \"{}\"", table.substr(0, 40))};
    }
    const auto options = options_of(*find_cam_operation(table), values, files);
    if (!options) return Failure{options.error()};
    text += fmt::format("[{}]\n", table);
    std::string last;
    for (const auto& [name, value] : *options) {
      if (std::exchange(last, name) == name) return Failure{fmt::format("\"{}\": expected one value", name)};
      // A JSON text is a TOML text, too.
      text += fmt::format("{} = {}\n", name,
                          value ? Json(*value).dump(-1, ' ', true, Json::error_handler_t::replace) : "true");
    }
  }
  return text;
}

// The error: the body is no order. `kept`: names of the files that were sent.
Result<CamOrder, std::string> order_from(const Json& said, const std::vector<std::string>& kept) {
  CamOrder order;
  const Json job = said.value("job", Json());
  const CamOperation* const operation = job.is_string() ? find_cam_operation(job.get<std::string>()) : nullptr;
  if (operation == nullptr) return Failure{"\"job\": expected one of GET /cam"};
  order.job = operation->name;
  const Json files = said.value("files", Json());
  const Json& said_options = said.contains("options") ? said["options"] : Json::object();
  const bool needs_no_files = said_options.is_object() && said_options.contains(operation->instead_of_files);
  const Failure no_files{"\"files\": expected names of files that were sent"};
  if (!files.is_array() || (files.empty() && !needs_no_files)) return no_files;
  for (const Json& one : files) {
    if (!one.is_string() || !has(kept, one.get<std::string>())) return no_files;
    order.files.push_back(one.get<std::string>());
  }
  const auto options = options_of(*operation, said_options, kept);
  if (!options) return Failure{options.error()};
  for (const auto& [name, value] : *options) {
    order.options.push_back("--" + name + (value ? "=" + *value : std::string()));
  }
  if (operation->parts.empty()) {
    if (said.contains("profile")) return Failure{fmt::format("\"profile\": {} has none", operation->name)};
    return order;
  }
  const auto profile = profile_of(*operation, said.contains("profile") ? said["profile"] : Json::object(), kept);
  if (!profile) return Failure{profile.error()};
  order.profile = *profile;
  return order;
}

// Whether feeds follow from a tool library, so that the machine's limits hold.
bool has_tools(const CamOrder& order) {
  return std::ranges::any_of(order.options, [](const std::string& word) { return word.starts_with("--tool-table="); });
}

}  // namespace

WebAnswer CamApi::state_answer(unsigned status) {
  poll();
  const CamService& maker = *shared_.options.maker;
  const CamResult& result = shared_.options.maker->result();
  const Json report = Json::parse(result.report, nullptr, false);
  Json jobs = Json::array();
  for (const CamOperation& operation : cam_operations()) jobs.push_back(operation.name);
  return json_answer(status, {{"jobs", jobs},
                              {"files", maker.files()},
                              {"state", name_of(result.state)},
                              {"job", result.job},
                              {"progress", result.progress},
                              {"words", result.words},
                              {"picture", result.picture_type},
                              {"program", made_.empty() ? Json() : Json(made_.front())},
                              {"programs", made_},
                              {"report", report.is_object() ? report : Json()},
                              {"page", result.has_page}});
}

WebAnswer CamApi::get(const ApiCall&) {
  return state_answer();
}

WebAnswer CamApi::operations(const ApiCall&) {
  Json all = Json::array();
  for (const CamOperation& operation : cam_operations()) all.push_back(schema_of(operation));
  return json_answer(
      200, {{"operations", std::move(all)}, {"part_kinds", part_kinds_json()}, {"tool_keys", tool_keys_json()}});
}

WebAnswer CamApi::picture(const ApiCall& call) {
  const CamResult& result = shared_.options.maker->result();
  const bool done = result.state == CamResult::State::done && !result.picture_type.empty();
  const std::string_view digits = call.query("number");
  std::size_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const std::optional<std::size_t> wanted = digits.empty() ? std::nullopt : std::optional(number);
  std::string picture = done ? shared_.options.maker->picture(wanted) : "";
  if (picture.empty()) return error_answer(404, "http.not-found", "there is no picture");
  return {.type = result.picture_type, .body = std::move(picture)};
}

// The page has its style within, and runs nothing.
WebAnswer CamApi::page(const ApiCall&) {
  if (!shared_.options.maker->result().has_page) return error_answer(404, "http.not-found", "there is no page");
  return {.type = "text/html; charset=utf-8",
          .body = shared_.options.maker->page(),
          .policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'"};
}

WebAnswer CamApi::keep_file(const ApiCall& call) {
  const auto name = name_from(call.request.query, "");
  if (!name) return name.error();
  if (name->empty() || name->front() == '-') return bad_body("the file has no name");
  if (!shared_.options.maker->keep(*name, call.request.body)) {
    return error_answer(507, "make.no-room",
                        "there is no room for this file: remove other files first, or free disk space");
  }
  return state_answer();
}

// One file by its name, or all.
WebAnswer CamApi::clear_files(const ApiCall& call) {
  const auto name = name_from(call.request.query, "");
  if (!name) return name.error();
  if (!name->empty()) {
    if (!shared_.options.maker->remove(*name))
      return error_answer(404, "http.not-found", "there is no file of this name");
    return state_answer();
  }
  shared_.options.maker->clear();
  made_.clear();
  return state_answer();
}

WebAnswer CamApi::begin(const ApiCall& call) {
  const Json& said = call.body;
  if (!said.is_object()) return bad_body("the body is not a JSON object");
  for (const auto& [name, value] : said.items()) {
    if (name != "job" && name != "files" && name != "options" && name != "profile")
      return bad_body("there is no \"" + name.substr(0, 40) + "\"");
  }
  if (shared_.options.maker == nullptr) return no_maker();
  CamService& maker = *shared_.options.maker;
  auto order = order_from(said, maker.files());
  if (!order) return bad_body(order.error());
  const MachineFileAccess& file = shared_.options.machine_access;
  const bool has_parts = !find_cam_operation(order->job)->parts.empty();
  if ((has_parts || has_tools(*order)) && file.read) order->machine = file.read().value_or("");
  if (!maker.begin(*order)) {
    if (maker.result().state == CamResult::State::running)
      return error_answer(409, "make.busy", "another program is being generated");
    return error_answer(507, "make.no-room", "there is no room for the generated files: free disk space");
  }
  made_.clear();
  making_ = order->job + "/" + (order->files.empty() ? std::string() : order->files.front());
  return state_answer(202);
}

void CamApi::poll() {
  if (making_.empty()) return;
  const CamResult& result = shared_.options.maker->result();
  if (result.state == CamResult::State::running) return;
  const std::string source = std::exchange(making_, {});
  if (result.state != CamResult::State::done) return;
  ProgramStore& programs = shared_.programs;
  const ApiJob& job = jobs_.job();
  const bool runs = job.state == JobState::checking || job.state == JobState::running;
  const auto is_gone = [&](std::uint64_t id) { return programs.find(id) == nullptr; };
  for (const std::uint64_t id : made_of_[source]) {
    if (!is_gone(id) && !(runs && job.program == id)) programs.remove(id);
  }
  for (auto& [name, ids] : made_of_) std::erase_if(ids, is_gone);
  std::erase_if(made_of_, [](const auto& one) { return one.second.empty(); });
  for (std::size_t i = 0; i < result.names.size(); ++i) {
    const StoredProgram* const program =
        programs.add(result.names[i], Dialect::linuxcnc, shared_.options.maker->program(i));
    made_.push_back(program != nullptr ? program->id : 0);
  }
  std::erase(made_, 0U);
  std::vector<std::uint64_t>& all = made_of_[source];
  all.insert(all.end(), made_.begin(), made_.end());
}

}  // namespace passo
