#include "settings_api.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_settings = 200;    // of one order
constexpr std::size_t longest_setting = 200;  // bytes, of a name or a value

const char* name_of(SettingsResult::State state) {
  switch (state) {
    case SettingsResult::State::none: return "none";
    case SettingsResult::State::running: return "running";
    case SettingsResult::State::done: return "done";
    case SettingsResult::State::failed: return "failed";
  }
  return "";
}

// A line end in a value would be a second line to the board.
bool is_one_word(const std::string& text) {
  return text.size() <= longest_setting && std::all_of(text.begin(), text.end(), [](char c) {
           return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F;
         });
}

bool is_setting_name(const std::string& name) {
  return is_one_word(name) && name.size() > 1 && name.front() == '$' && name.find('=') == std::string::npos;
}

std::optional<SettingsOrder::Kind> settings_kind_named(const Json& name) {
  using Kind = SettingsOrder::Kind;
  if (name == "read") return Kind::read;
  if (name == "write") return Kind::write;
  if (name == "compare") return Kind::compare;
  return name == "restore" ? std::optional(Kind::restore) : std::nullopt;
}

// Nothing: the body has another form.
std::optional<SettingsOrder> settings_order_of(const Json& said) {
  for (const auto& [name, value] : said.items()) {
    if (name != "order" && name != "values" && name != "file") return {};
  }
  const auto kind = settings_kind_named(said.value("order", Json()));
  if (!kind) return {};
  SettingsOrder order{.kind = *kind};
  if (*kind == SettingsOrder::Kind::write) {
    const Json values = said.value("values", Json());
    if (!values.is_object() || values.empty() || values.size() > most_settings) return {};
    for (const auto& [name, value] : values.items()) {
      if (!is_setting_name(name) || !value.is_string()) return {};
      order.values.emplace_back(name, value.get<std::string>());
      if (!is_one_word(order.values.back().second)) return {};
    }
  } else if (*kind != SettingsOrder::Kind::read) {
    const Json file = said.value("file", Json());
    if (!file.is_string()) return {};
    order.file = file.get<std::string>();
  }
  return order;
}

}  // namespace

WebAnswer SettingsApi::state_answer(unsigned status) const {
  const SettingsResult& result = settings().result();
  const Json report = Json::parse(result.report, nullptr, false);
  return json_answer(status, {{"has_board", settings().has_board()},
                              {"state", name_of(result.state)},
                              {"board", result.board},
                              {"words", result.words},
                              {"report", report.is_object() ? report : Json()}});
}

WebAnswer SettingsApi::get(const ApiCall&) {
  return state_answer(200);
}

WebAnswer SettingsApi::file(const ApiCall&) {
  const SettingsResult& result = settings().result();
  if (result.file.empty()) return error_answer(404, "settings.unread", "the settings have not been read yet");
  return {.type = "text/plain; charset=utf-8", .body = result.file};
}

WebAnswer SettingsApi::begin(const ApiCall& call) {
  const auto order = settings_order_of(call.members());
  if (!order) {
    return bad_body(
        "expected \"order\": read, write, compare or restore; to write, \"values\": texts by names such as $110; to "
        "compare or restore, \"file\": the text of a file of settings");
  }
  if (shared_.options.settings == nullptr) return no_settings();
  if (!settings().has_board()) {
    return error_answer(409, "settings.no-board", "no Grbl board is connected: open a port first");
  }
  if (shared_.session.busy() || jobs_.is_checking()) {
    return error_answer(409, "machine.busy",
                        Sentence{.code = "machine.busy.settings",
                                 .text = "the machine is moving: its settings can be used when it stops"});
  }
  if (!settings().begin(*order)) {
    return error_answer(409, "settings.busy", "the board is not at rest, or works at another order");
  }
  return state_answer(202);
}

}  // namespace passo
