#include "part_job_draft.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/base/fingerprint.hpp"
#include "passo/part_job/part_job.hpp"
#include "passo/part_job/part_kinds.hpp"
#include "passo/toml/fit_for_parser.hpp"
#include "passo/toml/toml_document.hpp"
#include "passo/toml/toml_text.hpp"

namespace passo {
namespace {

constexpr const char* operation_list = "operation";
constexpr int deepest_value = 3;
constexpr std::size_t most_new_keys = 100;

Json as_json(const TomlValue& value);

Json as_json(const TomlTable& table) {
  Json json = Json::object();
  for (const TomlEntry& entry : table.entries) json[entry.key] = as_json(entry.value);
  return json;
}

Json as_json(const TomlValue& value) {
  struct Writer {
    Json operator()(TomlDate) const { return nullptr; }
    Json operator()(bool flag) const { return flag; }
    Json operator()(double number) const { return std::isfinite(number) ? Json(number) : Json(); }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(const TomlArray& array) const {
      Json json = Json::array();
      for (const TomlValue& item : array) json.push_back(as_json(item));
      return json;
    }
    Json operator()(const TomlTable& table) const { return as_json(table); }
  };
  return std::visit(Writer{}, value.content);
}

Json table_of(const TomlTable& root, std::string_view key) {
  const TomlEntry* const entry = find(root, key);
  return entry != nullptr ? as_json(entry->value) : Json();
}

Json operation_json(const TomlValue& value) {
  Json lines = Json::object();
  if (const auto* table = std::get_if<TomlTable>(&value.content)) {
    for (const TomlEntry& entry : table->entries) lines[entry.key] = entry.place.line;
  }
  return {{"line", value.place.line}, {"values", as_json(value)}, {"lines", std::move(lines)}};
}

Json operations_json(const TomlTable& root) {
  Json all = Json::array();
  const TomlEntry* const list = find(root, operation_list);
  const auto* const items = list == nullptr ? nullptr : std::get_if<TomlArray>(&list->value.content);
  if (items == nullptr) return all;
  for (const TomlValue& item : *items) all.push_back(operation_json(item));
  return all;
}

// A job must not make the server read any other file: the tool library must be one that was sent.
bool reads_only_sent_files(const TomlTable& root, const std::vector<std::string>& sent) {
  const Json job = table_of(root, "job");
  const Json library = job.is_object() ? job.value("tools", Json()) : Json();
  return !library.is_string() || std::ranges::find(sent, library.get<std::string>()) != sent.end();
}

Diagnostic unsent_library(const std::string& file) {
  return {.severity = Severity::error,
          .code = "job.outside",
          .file = file,
          .place = {},
          .message = "the tool library of this job was not sent",
          .expected = "the name of a file that was sent, in job.tools",
          .text = {}};
}

Json tools_json(const PartJob& job) {
  Json tools = Json::array();
  for (const auto& [number, tool] : job.tools) {
    tools.push_back({{"number", number},
                     {"words", describe(tool.tool)},
                     {"shape", std::string(name_of(tool.tool.shape))},
                     {"feeds_from", tool.feeds_from}});
  }
  return tools;
}

// A value as TOML has it. Empty: none that a job file has.
std::string words_of(const Json& value, int depth = 0) {
  if (value.is_boolean()) return TomlText::words_of(value.get<bool>());
  if (value.is_number()) return TomlText::words_of(value.get<double>());
  if (value.is_string()) return TomlText::words_of(value.get<std::string>());
  if (!value.is_array() || depth >= deepest_value) return "";
  std::string words;
  for (const Json& item : value) {
    const std::string one = words_of(item, depth + 1);
    if (one.empty()) return "";
    words += (words.empty() ? "" : ", ") + one;
  }
  return "[" + words + "]";
}

// Why the parser must not read a text; empty: it may.
std::string unfit_for_parser(std::string_view text) {
  Diagnostics findings;
  const TomlReporter reporter(text, "", findings);
  return is_fit_for_parser(reporter) ? "" : std::string(findings.all().front().message);
}

class Editor {
 public:
  Editor(TomlText& text, const Json& edit) : text_(text), edit_(edit) {}

  // Empty: done.
  std::string apply();

 private:
  std::string insert();
  std::string path() const {
    return edit_.contains("path") && edit_["path"].is_string() ? edit_["path"].get<std::string>() : "";
  }
  std::size_t number(const char* key) const {
    return edit_.contains(key) && edit_[key].is_number_unsigned() ? edit_[key].get<std::size_t>() : 0;
  }
  // That of operations, if the edit does not name another one.
  std::string list() const {
    const Json named = edit_.is_object() ? edit_.value("list", Json(operation_list)) : Json();
    const std::string name = named.is_string() ? named.get<std::string>() : "";
    return name == operation_list || name == "clamp" || name == "fixture" ? name : "";
  }
  static std::string done(const Status<TomlTextError>& status) { return status ? "" : status.error().message; }

  TomlText& text_;
  const Json& edit_;
};

std::string Editor::insert() {
  std::vector<TomlText::NewKey> keys;
  const Json values = edit_.value("values", Json::object());
  if (!values.is_object() || values.size() > most_new_keys)
    return fmt::format("\"values\": expected an object with at most {} keys", most_new_keys);
  for (const auto& [key, value] : values.items()) {
    const std::string words = words_of(value);
    if (words.empty()) return fmt::format("{}: expected a number, a text, true, false, or a list of them", key);
    keys.push_back({key, words});
  }
  return done(text_.insert_table(list(), number("number"), keys));
}

std::string Editor::apply() {
  const std::string what =
      edit_.is_object() && edit_.contains("do") && edit_["do"].is_string() ? edit_["do"].get<std::string>() : "";
  if (what == "set") {
    const std::string words = words_of(edit_.value("value", Json()));
    if (words.empty()) return fmt::format("{}: expected a number, a text, true, false, or a list of them", path());
    return done(text_.set_words(path(), words));
  }
  if (what == "unset") return done(text_.remove(path()));
  if (what == "remove" && edit_.contains("path")) return done(text_.remove_table(path()));
  if (list().empty()) return "\"list\": expected operation, clamp or fixture";
  if (what == "insert") return insert();
  if (what == "copy") return done(text_.copy_table(list(), number("number")));
  if (what == "move") return done(text_.move_table(list(), number("number"), number("to")));
  if (what == "remove") return done(text_.remove_table(list(), number("number")));
  return "\"do\": expected set, unset, insert, copy, move or remove";
}

}  // namespace

std::string stamp_of_job(std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fmt::format("{:016x}", fingerprint.value());
}

Json draft_of_job(const std::string& text, const DraftPlace& place) {
  Json draft = {{"name", place.name},
                {"stamp", stamp_of_job(text)},
                {"text", text},
                {"editable", false},
                {"good", false},
                {"findings", Json::array()},
                {"job", nullptr},
                {"stock", nullptr},
                {"nest", nullptr},
                {"clamps", Json::array()},
                {"clamp_paths", Json::array()},
                {"tool_tables", nullptr},
                {"tools", Json::array()},
                {"operations", Json::array()}};
  Diagnostics syntax(most_sorted_errors);
  std::string_view bare = text;
  if (bare.starts_with("\xEF\xBB\xBF")) bare.remove_prefix(3);
  const TomlReporter reporter(bare, place.name, syntax, {.area = "job", .words = "a job file"});
  TomlDocument document;
  const bool is_fit = is_fit_for_parser(reporter);
  if (is_fit) document = parse_toml(std::string(bare), reporter);
  draft["editable"] = is_fit && document.complete;
  draft["job"] = table_of(document.root, "job");
  draft["stock"] = table_of(document.root, "stock");
  draft["nest"] = table_of(document.root, "nest");
  draft["tool_tables"] = table_of(document.root, "tool");
  for (const char* const list : {"clamp", "fixture"}) {
    const Json clamps = table_of(document.root, list);
    std::size_t number = 0;
    for (const Json& clamp : clamps.is_array() ? clamps : Json::array()) {
      ++number;
      if (!clamp.is_object()) continue;
      draft["clamps"].push_back(clamp);
      draft["clamp_paths"].push_back(fmt::format("{}.{}", list, number));
    }
  }
  draft["operations"] = operations_json(document.root);
  Diagnostics findings;
  std::optional<PartJob> job;
  if (!is_fit) {
    hand_over(syntax, findings);
  } else if (!reads_only_sent_files(document.root, place.files)) {
    findings.add(unsent_library(place.name));
  } else {
    job = parse_part_job(text, place.folder + place.name, findings);
  }
  draft["good"] = job.has_value();
  draft["findings"] = as_json(findings);
  if (job) draft["tools"] = tools_json(*job);
  return draft;
}

Result<std::string, std::string> edited_job(const std::string& text, const Json& edits) {
  if (!edits.is_array() || edits.size() > most_job_edits)
    return Failure{fmt::format("\"edits\": expected a list of at most {} edits", most_job_edits)};
  if (const std::string why = unfit_for_parser(text); !why.empty()) return Failure{why};
  auto toml = TomlText::read(text);
  if (!toml) return Failure{toml.error().message};
  for (const Json& edit : edits) {
    if (const std::string why = Editor(*toml, edit).apply(); !why.empty()) return Failure{why};
  }
  if (toml->text().size() > longest_job_text) {
    return Failure{fmt::format("the job file would be longer than {} bytes", longest_job_text)};
  }
  // A new value may be too long for a line. The text could then not be edited again.
  if (const std::string why = unfit_for_parser(toml->text()); !why.empty()) return Failure{why};
  return toml->text();
}

Json tool_keys_json() {
  constexpr std::array<const char*, 5> kinds = {"text", "choice", "flag", "number", "integer"};
  Json all = Json::array();
  for (const ToolKey& key : keys_of_part_tools()) {
    Json shapes = Json::array();
    for (const CuttingShape shape : key.shapes) shapes.push_back(std::string(name_of(shape)));
    Json row = {{"key", std::string(key.name)},
                {"kind", kinds[static_cast<std::size_t>(key.kind)]},
                {"shapes", std::move(shapes)},
                {"needed", key.is_needed}};
    if (!key.choices.empty()) row["choices"] = std::vector<std::string>(key.choices.begin(), key.choices.end());
    if (key.most > 0) row["range"] = {key.least, key.most};
    all.push_back(std::move(row));
  }
  return all;
}

Json part_kinds_json() {
  Json all = Json::array();
  for (const PartKindKeys& keys : keys_of_part_kinds()) {
    Json options = Json::array();
    for (const std::string_view option : keys.options) options.push_back(std::string(option));
    all.push_back({{"kind", std::string(name_of(keys.kind))},
                   {"command", std::string(keys.command)},
                   {"first_tool", std::string(keys.first_tool)},
                   {"file", std::string(keys.file)},
                   {"has_place", keys.has_place},
                   {"options", std::move(options)}});
  }
  return all;
}

}  // namespace passo
