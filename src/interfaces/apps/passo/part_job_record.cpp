#include "part_job_record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/base/counted.hpp"
#include "passo/base/fingerprint.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

using Json = nlohmann::ordered_json;

std::string hex(std::uint64_t value) {
  return fmt::format("{:016x}", value);
}

std::optional<std::string> bytes_of(const std::string& path) {
  Diagnostics ignored;
  return read_bytes(path, {.area = "job", .expected = "a file"}, ignored);
}

// All files that operations read: drawings, models, fonts, curves.
std::set<std::string> files_of(const PartJob& job) {
  std::set<std::string> files;
  for (const std::string& file :
       {job.library, job.program.start_text, job.program.tool_change_text, job.program.end_text}) {
    if (!file.empty()) files.insert(file);
  }
  for (const PartOperation& operation : job.operations) {
    files.insert(operation.files.begin(), operation.files.end());
    PartOperation copy = operation;
    for (const CamOption& option : cam_options_of(copy)) {
      const auto* const* text = std::get_if<std::string*>(&option.value);
      const bool is_read = option.kind == CamKind::file && option.name != "output" && option.name != "picture";
      if (is_read && text != nullptr && std::filesystem::is_regular_file(**text)) files.insert(**text);
    }
  }
  return files;
}

double rounded(double value) {
  return std::round(value * 1000) / 1000 + 0.0;
}

double total_seconds(const TriedOperation& tried) {
  return tried.cut_s + tried.rapid_mm / usual_rapid_mm_min * 60;
}

std::string time_words(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

// A record may have been edited by hand.
template <class Value>
Value value_of(const Json& json, const char* key, Value otherwise) {
  if (!json.is_object()) return otherwise;
  const auto found = json.find(key);
  if (found == json.end()) return otherwise;
  if constexpr (std::is_same_v<Value, std::string>) {
    return found->is_string() ? found->template get<std::string>() : otherwise;
  } else {
    return found->is_number() ? found->template get<Value>() : otherwise;
  }
}

const Json& list_of(const Json& json, const char* key) {
  static const Json nothing = Json::array();
  if (!json.is_object()) return nothing;
  const auto found = json.find(key);
  return found != json.end() && found->is_array() ? *found : nothing;
}

std::vector<std::string> texts_of(const Json& json, const char* key) {
  std::vector<std::string> texts;
  for (const Json& item : list_of(json, key)) {
    if (item.is_string()) texts.push_back(item.get<std::string>());
  }
  std::ranges::sort(texts);
  return texts;
}

std::vector<std::string> without(const std::vector<std::string>& all, const std::vector<std::string>& some) {
  std::vector<std::string> rest;
  std::ranges::set_difference(all, some, std::back_inserter(rest));
  return rest;
}

std::string listed(const std::vector<std::string>& contours, const char* what) {
  constexpr std::size_t most = 3;
  const std::size_t shown = std::min(most, contours.size());
  const std::string rest = contours.size() > most ? fmt::format(" and {} more", contours.size() - most) : "";
  return fmt::format("{} {}: {}{}", counted(contours.size(), "contour"), what,
                     fmt::join(contours.begin(), contours.begin() + static_cast<std::ptrdiff_t>(shown), ", "), rest);
}

// The text without the comment that names the fingerprint of the inputs, which changes with every comment of a file.
std::string without_inputs(std::string_view text, std::string fingerprint) {
  std::string rest;
  std::string capitals = fingerprint;
  std::ranges::transform(capitals, capitals.begin(),
                         [](char c) { return c >= 'a' && c <= 'f' ? char(c - 'a' + 'A') : c; });
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    const bool is_found =
        line.find(fingerprint) != std::string_view::npos || line.find(capitals) != std::string_view::npos;
    if (fingerprint.empty() || !is_found) rest += line;
    text.remove_prefix(end);
  }
  return rest;
}

// "plate-1-T1.ngc, plate-2-T2.ngc"
std::string names_in(const Json& record, const char* list, const char* key) {
  std::string names;
  for (const Json& item : list_of(record, list)) {
    names += (names.empty() ? "" : ", ") + value_of<std::string>(item, key, "");
  }
  return names;
}

// The differences between whole programs. Records of earlier versions lack some keys.
void add_changes_of_programs(const Json& before, const Json& now, std::vector<std::string>& lines) {
  const auto text = [](const Json& record, const char* key) { return value_of<std::string>(record, key, ""); };
  if (before.contains("for") && text(before, "for") != text(now, "for")) {
    lines.push_back(fmt::format("controller {} -> {}", text(before, "for"), text(now, "for")));
  }
  const std::string old_names = names_in(before, "programs", "file");
  const std::string new_names = names_in(now, "programs", "file");
  if (old_names != new_names) {
    lines.push_back(fmt::format("programs {} -> {}", old_names, new_names));
    return;
  }
  if (lines.empty() && names_in(before, "operations", "title") != names_in(now, "operations", "title")) {
    lines.emplace_back("the order of the operations");
  }
  const std::string old_words = names_in(before, "programs", "words");
  const bool knows_words = old_words.find_first_not_of(", ") != std::string::npos;
  if (lines.empty() && knows_words && old_words != names_in(now, "programs", "words")) {
    lines.push_back(fmt::format("the words of {}", new_names));
  }
}

// The differences between two entries of the same operation. Empty: none.
std::string changes_of_operation(const Json& before, const Json& now) {
  std::vector<std::string> changes;
  const auto number = [&](const char* key, const char* words, double least) {
    const double a = value_of(before, key, 0.0);
    const double b = value_of(now, key, 0.0);
    if (std::abs(a - b) > least) changes.push_back(fmt::format("{} {:g} -> {:g}", words, a, b));
  };
  number("tool", "tool", 0);
  number("depth_mm", "depth", 1e-3);
  number("moves", "moves", 0);
  const double a = value_of(before, "cut_s", 0.0);
  const double b = value_of(now, "cut_s", 0.0);
  if (std::lround(a) != std::lround(b)) changes.push_back(fmt::format("time {} -> {}", time_words(a), time_words(b)));
  const auto contours_before = texts_of(before, "contours");
  const auto contours_now = texts_of(now, "contours");
  if (const auto added = without(contours_now, contours_before); !added.empty())
    changes.push_back(listed(added, "added"));
  if (const auto gone = without(contours_before, contours_now); !gone.empty())
    changes.push_back(listed(gone, "removed"));
  return fmt::format("{}", fmt::join(changes, "; "));
}

}  // namespace

std::string record_file_of(const std::string& output) {
  return std::filesystem::path(output).replace_extension(".job.json").string();
}

std::string fingerprint_of_text(std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return hex(fingerprint.value());
}

std::string fingerprint_of_inputs(const PartJob& job, const std::string& job_text) {
  Fingerprint fingerprint;
  fingerprint.add(std::string_view(PASSO_VERSION));
  fingerprint.add(std::string_view(job_text));
  for (const std::string& file : files_of(job)) {
    const auto bytes = bytes_of(file);
    if (!bytes) return "";
    fingerprint.add(std::string_view(*bytes));
  }
  return hex(fingerprint.value());
}

Json record_of(const MadeJob& made) {
  const PartJob& job = made.job;
  Json operations = Json::array();
  double total_s = 0;
  double stock_left = made.trial.stock_mm3;
  for (const OrderedOperation& ordered : made.order) {
    const PartOperation& operation = job.operations[ordered.index];
    const TriedOperation& tried = made.trial.operations[ordered.index];
    const MadeOperation& one = made.made[ordered.index];
    total_s += total_seconds(tried);
    stock_left = std::max(0.0, stock_left - tried.removed_mm3);
    const double share_left = made.trial.stock_mm3 > 0 ? stock_left / made.trial.stock_mm3 : 0;
    Json json = {{"title", operation.title},
                 {"kind", std::string(name_of(operation.kind))},
                 {"written", ordered.index + 1},
                 {"line", operation.place.line},
                 {"tool", operation.tool},
                 {"depth_mm", rounded(tried.depth_mm)},
                 {"moves", tried.moves},
                 {"cut_mm", rounded(tried.cut_mm)},
                 {"cut_s", rounded(tried.cut_s)},
                 {"rapid_mm", rounded(tried.rapid_mm)},
                 {"removed_mm3", rounded(tried.removed_mm3)},
                 {"stock_left_mm3", rounded(stock_left)},
                 {"stock_left_percent", rounded(100 * share_left)},
                 {"reason", ordered.reason},
                 {"contours", one.contours},
                 {"notes", one.notes}};
    if (!one.figures.is_null()) json["figures"] = one.figures;
    operations.push_back(std::move(json));
  }
  Json programs = Json::array();
  for (const TrialProgram& program : made.programs) {
    programs.push_back({{"file", std::filesystem::path(program.file).filename().string()},
                        {"fingerprint", fingerprint_of_text(program.text)},
                        {"words", fingerprint_of_text(without_inputs(program.text, made.fingerprint))}});
  }
  return {{"job", job.name},
          {"fingerprint", made.fingerprint},
          {"for", job.program.controller},
          {"programs", std::move(programs)},
          {"stock_mm3", rounded(made.trial.stock_mm3)},
          {"tool_changes", tool_changes(job, made.order)},
          {"operations", std::move(operations)},
          {"total_s", rounded(total_s)}};
}

std::optional<Json> read_job_record(const std::string& output) {
  const auto bytes = bytes_of(record_file_of(output));
  if (!bytes) return std::nullopt;
  Json record = Json::parse(*bytes, nullptr, false);
  if (record.is_discarded() || !record.is_object()) return std::nullopt;
  return record;
}

std::vector<RecordedProgram> programs_of_record(const Json& record) {
  std::vector<RecordedProgram> programs;
  for (const Json& program : list_of(record, "programs")) {
    programs.push_back({std::filesystem::path(value_of<std::string>(program, "file", "")).filename().string(),
                        value_of<std::string>(program, "fingerprint", "")});
  }
  return programs;
}

std::string out_of_date(const Json& record, const std::string& fingerprint, const std::string& output) {
  if (value_of<std::string>(record, "fingerprint", "") != fingerprint) {
    return "the job file, a drawing or the version of Passo has changed";
  }
  const std::vector<RecordedProgram> programs = programs_of_record(record);
  if (programs.empty()) return "the record lists no program";
  for (const RecordedProgram& program : programs) {
    const std::string file = (std::filesystem::path(output).parent_path() / program.name).string();
    const auto text = bytes_of(file);
    if (!text) return fmt::format("{} is missing", file);
    if (fingerprint_of_text(*text) != program.fingerprint) {
      return fmt::format("{} was edited", file);
    }
  }
  return "";
}

std::vector<std::string> changes_of(const Json& before, const Json& now) {
  std::map<std::string, const Json*> old;
  for (const Json& operation : list_of(before, "operations")) {
    old.emplace(value_of<std::string>(operation, "title", ""), &operation);
  }
  std::vector<std::string> lines;
  for (const Json& operation : list_of(now, "operations")) {
    const std::string title = value_of<std::string>(operation, "title", "");
    const auto found = old.find(title);
    if (found == old.end()) {
      lines.push_back(fmt::format("'{}' is new", title));
      continue;
    }
    if (const std::string changes = changes_of_operation(*found->second, operation); !changes.empty()) {
      lines.push_back(fmt::format("'{}': {}", title, changes));
    }
    old.erase(found);
  }
  for (const auto& [title, operation] : old) lines.push_back(fmt::format("'{}' was removed", title));
  add_changes_of_programs(before, now, lines);
  return lines;
}

std::string report_of(const Json& record) {
  std::size_t widest = 9;
  for (const Json& operation : list_of(record, "operations")) {
    widest = std::max(widest, value_of<std::string>(operation, "title", "").size());
  }
  std::string text =
      fmt::format("{:>2}  {:<{}}  {:<11}  {:>4}  {:>7}  {:>6}  {:>8}  {:>9}  {:>8}  {:>7}\n", "#", "operation", widest,
                  "kind", "tool", "deep mm", "moves", "cut time", "cut mm", "rapid mm", "stock %");
  std::string reasons;
  std::size_t number = 0;
  for (const Json& operation : list_of(record, "operations")) {
    const std::string title = value_of<std::string>(operation, "title", "");
    text += fmt::format("{:>2}  {:<{}}  {:<11}  {:>4}  {:>7.2f}  {:>6}  {:>8}  {:>9.0f}  {:>8.0f}  {:>7.2f}\n",
                        ++number, title, widest, value_of<std::string>(operation, "kind", ""),
                        fmt::format("T{}", value_of(operation, "tool", 0)), value_of(operation, "depth_mm", 0.0),
                        value_of(operation, "moves", std::uint64_t{0}), time_words(value_of(operation, "cut_s", 0.0)),
                        value_of(operation, "cut_mm", 0.0), value_of(operation, "rapid_mm", 0.0),
                        value_of(operation, "stock_left_percent", 0.0));
    const std::string reason = value_of<std::string>(operation, "reason", "");
    if (!reason.empty() && number != value_of(operation, "written", std::size_t{0})) {
      reasons += fmt::format("order: '{}' is number {} instead of {}: {}\n", title, number,
                             value_of(operation, "written", 0), reason);
    }
  }
  text += reasons;
  text += fmt::format("total: {} with rapids at {:g} mm/min, without acceleration and tool changes; {}\n",
                      time_words(value_of(record, "total_s", 0.0)), usual_rapid_mm_min,
                      counted(value_of(record, "tool_changes", std::size_t{0}), "tool change"));
  return text;
}

}  // namespace passo
