#include "cam_api.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::array<std::string_view, 9> jobs = {"profile", "pocket", "engrave", "drill", "isolate",
                                                  "outline", "board",  "relief",  "wire"};
// Whose options a board's order may have, too.
constexpr std::array<std::string_view, 3> board_tables = {"drill", "isolate", "outline"};
// Options that name files of this computer, or that belong to the program itself.
constexpr std::array<std::string_view, 7> own_options = {"output",  "picture",  "json", "profile",
                                                         "machine", "remember", "help"};
constexpr std::size_t longest_value = 200;
constexpr std::size_t most_options = 60;
constexpr std::size_t most_values = 200;

const char* name_of(MakeResult::State state) {
  switch (state) {
    case MakeResult::State::none: return "none";
    case MakeResult::State::running: return "running";
    case MakeResult::State::done: return "done";
    case MakeResult::State::failed: return "failed";
  }
  return "";
}

template <class List>
bool has(const List& list, std::string_view one) {
  return std::ranges::find(list, one) != std::ranges::end(list);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_option(std::string_view name) {
  return !name.empty() && name.size() < 40 && name.front() != '-' && !has(own_options, name) &&
         std::ranges::all_of(name, [](char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '-'; });
}

// Lengths, names and numbers: 1/32in has a slash between digits, and no other value has one.
bool is_value(std::string_view value) {
  if (value.size() > longest_value || value.find("..") != std::string_view::npos) return false;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const char c = value[i];
    if (c == '/') {
      if (i == 0 || i + 1 == value.size() || !is_digit(value[i - 1]) || !is_digit(value[i + 1])) return false;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\') {
      return false;
    }
  }
  return true;
}

struct MakeOption {
  std::string name;
  std::optional<std::string> value;  // empty: a flag
};

// Empty, with a reason: the options are none.
std::optional<std::vector<MakeOption>> options_of(const Json& json, std::string& reason) {
  std::vector<MakeOption> options;
  if (!json.is_object() || json.size() > most_options) {
    reason = "\"options\": expected an object";
    return {};
  }
  for (const auto& [name, value] : json.items()) {
    reason = fmt::format("there is no option \"{}\" here", name.substr(0, 40));
    if (!is_option(name)) return {};
    if (value.is_boolean()) {
      if (value.get<bool>()) options.push_back({name, {}});
      continue;
    }
    reason = fmt::format("\"{}\": expected a text, a number, true or false, or a list of texts", name);
    for (const Json& one : value.is_array() ? value : Json::array({value})) {
      const bool is_number = one.is_number() && std::isfinite(one.get<double>());
      if (!is_number && !one.is_string()) return {};
      const std::string text = is_number ? fmt::format("{}", one.get<double>()) : one.get<std::string>();
      if (text.empty()) continue;
      if (!is_value(text) || options.size() >= most_values) return {};
      options.push_back({name, text});
    }
  }
  reason.clear();
  return options;
}

// As lines of a profile (machine_file/option_profile.hpp). Empty, with a reason: there is no such profile.
std::optional<std::string> profile_of(const Json& json, std::string& reason) {
  std::string text;
  if (!json.is_object()) {
    reason = "\"profile\": expected an object";
    return {};
  }
  for (const auto& [table, values] : json.items()) {
    reason = fmt::format("\"profile\": there is no table \"{}\"", table.substr(0, 40));
    if (!has(board_tables, table)) return {};
    const auto options = options_of(values, reason);
    if (!options) return {};
    text += fmt::format("[{}]\n", table);
    std::string last;
    for (const auto& [name, value] : *options) {
      reason = fmt::format("\"{}\": expected one value", name);
      if (std::exchange(last, name) == name) return {};
      // A JSON text is a TOML text, too.
      text += fmt::format("{} = {}\n", name,
                          value ? Json(*value).dump(-1, ' ', true, Json::error_handler_t::replace) : "true");
    }
  }
  reason.clear();
  return text;
}

// Empty, with a reason: the body is no order. `kept`: names of the files that were sent.
std::optional<MakeOrder> order_from(const Json& said, const std::vector<std::string>& kept, std::string& reason) {
  MakeOrder order;
  const Json job = said.value("job", Json());
  if (!job.is_string() || !has(jobs, job.get<std::string>())) {
    reason = "\"job\": expected one of GET /cam";
    return {};
  }
  order.job = job.get<std::string>();
  const Json files = said.value("files", Json());
  const Json& said_options = said.contains("options") ? said["options"] : Json::object();
  const bool has_letters = order.job == "engrave" && said_options.is_object() && said_options.contains("text");
  reason = "\"files\": expected names of files that were sent";
  if (!files.is_array() || (files.empty() && !has_letters)) return {};
  for (const Json& one : files) {
    if (!one.is_string() || !has(kept, one.get<std::string>())) return {};
    order.files.push_back(one.get<std::string>());
  }
  const auto options = options_of(said_options, reason);
  if (!options) return {};
  for (const auto& [name, value] : *options) {
    order.options.push_back("--" + name + (value ? "=" + *value : std::string()));
  }
  if (order.job != "board") {
    reason = "\"profile\": only a board has one";
    return said.contains("profile") ? std::nullopt : std::optional(std::move(order));
  }
  const auto profile = profile_of(said.contains("profile") ? said["profile"] : Json::object(), reason);
  if (!profile) return {};
  order.profile = *profile;
  return order;
}

}  // namespace

WebAnswer CamApi::state_answer(unsigned status) {
  turn();
  const Maker& maker = *shared_.options.maker;
  const MakeResult& result = shared_.options.maker->look();
  const Json report = Json::parse(result.report, nullptr, false);
  return json_answer(status, {{"jobs", jobs},
                              {"files", maker.files()},
                              {"state", name_of(result.state)},
                              {"job", result.job},
                              {"words", result.words},
                              {"picture", result.picture_type},
                              {"program", made_.empty() ? Json() : Json(made_.front())},
                              {"programs", made_},
                              {"report", report.is_object() ? report : Json()},
                              {"page", result.has_page}});
}

WebAnswer CamApi::look(const ApiCall&) {
  return state_answer();
}

WebAnswer CamApi::picture(const ApiCall& call) {
  const MakeResult& result = shared_.options.maker->look();
  const bool done = result.state == MakeResult::State::done && !result.picture_type.empty();
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
  if (!shared_.options.maker->look().has_page) return error_answer(404, "http.not-found", "there is no page");
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
                        "there is no room for this file: clear the others first, or make room on the disk");
  }
  return state_answer();
}

WebAnswer CamApi::clear_files(const ApiCall&) {
  shared_.options.maker->clear();
  made_.clear();
  return state_answer();
}

WebAnswer CamApi::begin(const ApiCall& call) {
  const Json& said = call.body;
  if (!said.is_object()) return bad_body("the body is no JSON object");
  for (const auto& [name, value] : said.items()) {
    if (name != "job" && name != "files" && name != "options" && name != "profile")
      return bad_body("there is no \"" + name.substr(0, 40) + "\"");
  }
  if (shared_.options.maker == nullptr) return no_maker();
  Maker& maker = *shared_.options.maker;
  std::string reason;
  auto order = order_from(said, maker.files(), reason);
  if (!order) return bad_body(reason);
  const MachineFileAccess& file = shared_.options.machine_access;
  if (order->job == "board" && file.read) order->machine = file.read().value_or("");
  if (!maker.begin(*order)) {
    if (maker.look().state == MakeResult::State::running)
      return error_answer(409, "make.busy", "another program is being made");
    return error_answer(507, "make.no-room", "there is no room for what is to be made: make room on the disk");
  }
  made_.clear();
  making_ = order->job + "/" + (order->files.empty() ? std::string() : order->files.front());
  return state_answer(202);
}

void CamApi::turn() {
  if (making_.empty()) return;
  const MakeResult& result = shared_.options.maker->look();
  if (result.state == MakeResult::State::running) return;
  const std::string source = std::exchange(making_, {});
  if (result.state != MakeResult::State::done) return;
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
