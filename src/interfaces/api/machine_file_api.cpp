#include "machine_file_api.hpp"

#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/base/fingerprint.hpp"
#include "passo/toml/toml_text.hpp"

namespace passo {
namespace {

constexpr std::size_t most_changes = 200;  // of one request

std::string stamp_of(std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fmt::format("{:016x}", fingerprint.value());
}

// A member that nobody knows is a mistake.
bool has_only(const Json& said, std::string_view one, std::string_view other) {
  for (const auto& [name, value] : said.items()) {
    if (name != one && name != other) return false;
  }
  return true;
}

Json as_json(const TomlText::Setting& setting) {
  return std::visit([](const auto& value) { return Json(value); }, setting);
}

// Empty: no machine file has such a value.
std::optional<TomlText::Setting> setting_of(const Json& json) {
  if (json.is_boolean()) return TomlText::Setting(json.get<bool>());
  if (json.is_number()) return TomlText::Setting(json.get<double>());
  if (json.is_string()) return TomlText::Setting(json.get<std::string>());
  if (!json.is_array()) return {};
  std::vector<double> list;
  for (const Json& one : json) {
    if (!one.is_number()) return {};
    list.push_back(one.get<double>());
  }
  return TomlText::Setting(std::move(list));
}

// What the editor shows of a text: its values if it is sound, and what is wrong if it is not.
Json draft_json(const std::string& text, const std::string& name) {
  Diagnostics findings;
  const auto machine = parse_machine(text, name, findings, MachineUse::any_board);
  Json values = Json::object();
  if (machine) {
    const auto toml = TomlText::read(text);
    if (toml) {
      for (const TomlText::Value& one : toml->values()) values[one.path] = as_json(one.setting);
    }
  }
  return {{"text", text},
          {"good", machine.has_value()},
          {"values", std::move(values)},
          {"axes", machine ? machine_json(*machine, {}, "")["axes"] : Json::array()},
          {"findings", as_json(findings)}};
}

Json unset_json(std::string text, std::string message) {
  return {{"text", std::move(text)},
          {"good", false},
          {"values", Json::object()},
          {"axes", Json::array()},
          {"findings", Json::array({{{"severity", "error"},
                                     {"code", "machine-file.cannot-set"},
                                     {"line", 0},
                                     {"column", 0},
                                     {"message", std::move(message)},
                                     {"expected", ""},
                                     {"message_sentence", as_json(Sentence{.code = "machine-file.cannot-set"})},
                                     {"expected_sentence", as_json(Sentence())}}})}};
}

}  // namespace

// Reading a machine file may take some milliseconds: nothing waits for them while nothing moves.
std::optional<WebAnswer> MachineFileApi::refuse_while_moving() const {
  if (!shared_.session.busy() && !jobs_.is_checking()) return {};
  return error_answer(409, "machine.busy",
                      Sentence{.code = "machine.busy.machine-file",
                               .text = "the machine is moving: the machine file can be changed when it stops"});
}

WebAnswer MachineFileApi::get(const ApiCall&) {
  const MachineFileAccess& file = shared_.options.machine_access;
  const FileStamp& in_force = shared_.options.machine_access.stamp;
  const auto text = file.read ? file.read() : std::nullopt;
  if (!text) return error_answer(404, "machine-file.none", "the machine file cannot be read");
  Json json = draft_json(*text, file.name);
  Fingerprint fingerprint;
  fingerprint.add(*text);
  json["name"] = file.name;
  json["stamp"] = stamp_of(*text);
  json["in_force"] = in_force.size == text->size() && in_force.fingerprint == fingerprint.value();
  json["writable"] = file.write != nullptr;
  return json_answer(200, json);
}

WebAnswer MachineFileApi::draft(const ApiCall& call) {
  if (auto refused = refuse_while_moving()) return std::move(*refused);
  const MachineFileAccess& file = shared_.options.machine_access;
  const Json& said = call.body;
  if (!said.is_object() || !said.contains("text") || !said["text"].is_string() || !has_only(said, "text", "set")) {
    return bad_body("expected \"text\", that of a machine file, and \"set\"");
  }
  std::string text = said["text"].get<std::string>();
  const Json changes = said.value("set", Json::object());
  if (!changes.is_object() || changes.size() > most_changes) {
    return bad_body("\"set\": expected an object with values by their paths");
  }
  Json draft = draft_json(text, file.name);
  // Only what a machine file may be is changed value by value.
  if (changes.empty() || draft["good"] == false) return json_answer(200, draft);
  auto toml = TomlText::read(text);
  if (!toml) return json_answer(200, unset_json(std::move(text), toml.error().message));
  for (const auto& [path, value] : changes.items()) {
    const auto setting = setting_of(value);
    if (!setting)
      return bad_body(fmt::format("{}: expected a number, a text, true, false, or a list of numbers", path));
    if (const auto done = toml->set(path, *setting); !done) {
      return json_answer(200, unset_json(toml->text(), done.error().message));
    }
  }
  return json_answer(200, draft_json(toml->text(), file.name));
}

WebAnswer MachineFileApi::write(const ApiCall& call) {
  if (auto refused = refuse_while_moving()) return std::move(*refused);
  const MachineFileAccess& file = shared_.options.machine_access;
  const Json& said = call.body;
  const auto has_text = [&](const char* key) {
    return said.is_object() && said.contains(key) && said[key].is_string();
  };
  if (!has_text("text") || !has_text("stamp") || !has_only(said, "text", "stamp")) {
    return bad_body("expected \"text\", and the \"stamp\" of the file that was changed");
  }
  const auto before = file.read ? file.read() : std::nullopt;
  if (!file.write || !before) {
    return error_answer(409, "machine-file.none",
                        "there is no machine file to write: start passo serve with --machine");
  }
  if (stamp_of(*before) != said["stamp"].get<std::string>()) {
    return error_answer(409, "machine-file.changed", "the machine file was changed in the meantime: load it again");
  }
  const std::string text = said["text"].get<std::string>();
  Diagnostics findings;
  if (!parse_machine(text, file.name, findings, MachineUse::any_board)) {
    const FindingWords why = findings.all().empty() ? "it has errors" : findings.all().front().message;
    return error_answer(409, "machine-file.unsound",
                        Sentence{.code = "machine-file.unsound",
                                 .arguments = held_as("finding", why),
                                 .text = fmt::format("invalid machine file: {}", why)});
  }
  if (const std::string why = file.write(*before, text); !why.empty()) {
    return error_answer(507, "machine-file.unwritten",
                        Sentence{.code = "machine-file.unwritten",
                                 .arguments = {{"name", file.name}, {"why", why}},
                                 .text = fmt::format("{} cannot be written: {}", file.name, why)});
  }
  return get(call);
}

}  // namespace passo
