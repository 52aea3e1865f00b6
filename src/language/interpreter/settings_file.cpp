#include "passo/interpreter/settings_file.hpp"

#include "file_fields.hpp"
#include "file_place.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

std::string key_of(std::string_view section, std::string_view name) {
  std::string key;
  const auto append = [&key](std::string_view text) {
    for (const char c : text) {
      if (c != ' ' && c != '\t') key += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
  };
  append(section);
  key += ']';
  append(name);
  return key;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// A '#' at the beginning or after a blank begins a comment. A '#' inside a word does not.
std::string_view without_comment(std::string_view value) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (value[i] == '#' && (i == 0 || value[i - 1] == ' ' || value[i - 1] == '\t')) return trimmed(value.substr(0, i));
  }
  return value;
}

// A setting of LinuxCNC that changes what programs mean, and that Passo does not follow.
struct Unfollowed {
  std::string_view section;
  std::string_view name;
  Severity severity;
  std::string_view
      harmless;           // the values that change nothing, each between blanks; empty: every value changes something
  std::string_view what;  // what the setting does, and Passo does not
};
constexpr Unfollowed unfollowed[] = {
    {"RS274NGC", "REMAP", Severity::error, "", "codes are remapped"},
    {"RS274NGC", "FEATURES", Severity::error, " 0 4 8 12 ",
     "bits other than 4 (INI_VARS) and 8 (HAL_PIN_VARS) are set"},
    {"RS274NGC", "RETAIN_G43", Severity::error, " 0 no false off ", "the tool offset changes with the tool"},
    {"RS274NGC", "OWORD_NARGS", Severity::error, " 0 no false off ", "#<n_args> is the number of arguments of a call"},
    {"RS274NGC", "NO_DOWNCASE_OWORD", Severity::error, " 0 no false off ", "names of subroutines are case-sensitive"},
    {"RS274NGC", "OWORD_WARNONLY", Severity::warning, " 0 no false off ", "errors of O-words are warnings"},
    {"RS274NGC", "OWORD_WARN_ONLY", Severity::warning, " 0 no false off ", "errors of O-words are warnings"},
    {"RS274NGC", "CENTER_ARC_RADIUS_TOLERANCE_INCH", Severity::error, "",
     "arcs are checked with a different tolerance"},
    {"RS274NGC", "CENTER_ARC_RADIUS_TOLERANCE_MM", Severity::error, "", "arcs are checked with a different tolerance"},
    {"RS274NGC", "PARAMETER_G73_PECK_CLEARANCE", Severity::error, "", "pecks have a different clearance"},
    {"RS274NGC", "PARAMETER_G83_PECK_CLEARANCE", Severity::error, "", "pecks have a different clearance"},
    {"RS274NGC", "RS274NGC_STARTUP_CODE", Severity::warning, "", "these codes run before each program"},
    {"RS274NGC", "ON_ABORT_COMMAND", Severity::warning, "", "this command runs after an abort"},
    {"EMCIO", "RANDOM_TOOLCHANGER", Severity::error, " 0 ", "tools change their pockets"},
    {"EMCIO", "DB_PROGRAM", Severity::error, "", "tools come from a database"},
    {"EMCIO", "TOOL_CHANGE_WITH_SPINDLE_ON", Severity::error, " 0 ", "M6 leaves the spindle on"},
    {"EMCIO", "TOOL_CHANGE_QUILL_UP", Severity::error, " 0 ", "M6 moves Z up"},
    {"EMCIO", "TOOL_CHANGE_AT_G30", Severity::error, " 0 ", "M6 moves to the G30 position"},
    {"EMCIO", "TOOL_CHANGE_POSITION", Severity::warning, "", "M6 moves to this position"},
    {"AXIS_A", "WRAPPED_ROTARY", Severity::error, " 0 no false off ",
     "in G90 the sign of A is the direction of rotation"},
    {"AXIS_B", "WRAPPED_ROTARY", Severity::error, " 0 no false off ",
     "in G90 the sign of B is the direction of rotation"},
    {"AXIS_C", "WRAPPED_ROTARY", Severity::error, " 0 no false off ",
     "in G90 the sign of C is the direction of rotation"},
    {"AXIS_A", "LOCKING_INDEXER_JOINT", Severity::error, " -1 ", "A moves only by itself, unlocked, with G0"},
    {"AXIS_B", "LOCKING_INDEXER_JOINT", Severity::error, " -1 ", "B moves only by itself, unlocked, with G0"},
    {"AXIS_C", "LOCKING_INDEXER_JOINT", Severity::error, " -1 ", "C moves only by itself, unlocked, with G0"},
    {"PYTHON", "TOPLEVEL", Severity::warning, "", "subroutines can be Python functions"},
    {"WIZARD", "WIZARD_ROOT", Severity::warning, "", "subroutines are also searched for in this folder"},
    {"TRAJ", "ANGULAR_UNITS", Severity::error, " deg degree 1 1.0 ", "angles are not in degrees"},
};

bool is_one_of(std::string_view list, std::string_view value) {
  std::string word = " ";
  for (const char c : value) word += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return list.find(word + " ") != std::string_view::npos;
}

void report_unfollowed(FieldReader& fields, std::string_view section, const Field& line, std::string_view name,
                       std::string_view value) {
  const std::string key = key_of(section, name);
  for (const Unfollowed& setting : unfollowed) {
    if (key != key_of(setting.section, setting.name) || is_one_of(setting.harmless, value)) continue;
    const std::string message =
        fmt::format("[{}]{} is ignored; in LinuxCNC, it means that {}", setting.section, setting.name, setting.what);
    const std::string expected = setting.harmless.empty()
                                     ? std::string("no such setting")
                                     : fmt::format("one of these values:{}or no such setting", setting.harmless);
    fields.report(setting.severity, "settings.not-followed", line, message, expected);
    return;
  }
}

}  // namespace

bool SettingsFile::read(const std::string& path, Diagnostics& diagnostics) {
  *this = {};
  Result<ProgramReader, Diagnostic> reader = ProgramReader::open(path);
  if (!reader) {
    Diagnostic problem = reader.error();
    if (problem.code == "file.empty") return true;
    problem.expected = "a settings file in INI format: [SECTION] and NAME = VALUE";
    diagnostics.add(std::move(problem));
    return false;
  }
  folder_ = folder_of_file(path);
  const std::size_t before = diagnostics.errors();
  FieldReader fields(std::move(*reader), diagnostics);
  std::string section;
  while (fields.next_line()) {
    const Field line = fields.rest();
    if (line.text.empty() || line.text.front() == '#' || line.text.front() == ';') continue;
    if (line.text.front() == '[') {
      const std::size_t close = line.text.find(']');
      if (close == std::string_view::npos) {
        fields.error("settings.bad-section", line, "the section's name is not closed", "']' after the name");
      } else {
        section = line.text.substr(1, close - 1);
      }
      continue;
    }
    const std::size_t equals = line.text.find('=');
    const std::string_view name = trimmed(line.text.substr(0, std::min(equals, line.text.size())));
    if (equals == std::string_view::npos || name.empty()) {
      fields.error("settings.bad-line", line, fmt::format("'{}' is not a setting", quoted(line.text)), "NAME = VALUE");
    } else if (!set(section, name, without_comment(trimmed(line.text.substr(equals + 1))))) {
      fields.error("settings.too-many", line, fmt::format("more than {} settings", most_settings), "a shorter file");
      break;
    } else {
      report_unfollowed(fields, section, line, name, without_comment(trimmed(line.text.substr(equals + 1))));
    }
  }
  return diagnostics.errors() == before;
}

bool SettingsFile::set(std::string_view section, std::string_view name, std::string_view value) {
  if (values_.size() >= most_settings) return false;
  values_.try_emplace(key_of(section, name), value);
  return true;
}

std::optional<std::string_view> SettingsFile::find(std::string_view section, std::string_view name) const {
  const auto found = values_.find(key_of(section, name));
  return found == values_.end() ? std::nullopt : std::optional<std::string_view>(found->second);
}

std::optional<double> SettingsFile::number(std::string_view section, std::string_view name) const {
  const std::optional<std::string_view> text = find(section, name);
  return text ? number_of(*text) : std::nullopt;
}

bool SettingsFile::is_on(std::string_view section, std::string_view name) const {
  const std::optional<std::string_view> text = find(section, name);
  return text && is_one_of(" 1 yes true on ", *text);
}

std::optional<double> SettingsFile::parameter(std::string_view parameter) const {
  constexpr std::string_view opening = "_ini[";
  const std::size_t close = parameter.find(']');
  if (!parameter.starts_with(opening) || close == std::string_view::npos) return std::nullopt;
  if (number("RS274NGC", "INI_VARS") == 0) return std::nullopt;
  return number(parameter.substr(opening.size(), close - opening.size()), parameter.substr(close + 1));
}

std::optional<LengthUnits> SettingsFile::machine_units() const {
  for (const char* const section : {"TRAJ", "AXIS", "AXIS_X", "JOINT_0"}) {
    const auto text = find(section, section[0] == 'T' ? "LINEAR_UNITS" : "UNITS");
    if (!text) continue;
    if (*text == "mm" || *text == "metric") return LengthUnits::mm;
    if (*text == "inch" || *text == "in" || *text == "imperial") return LengthUnits::inch;
  }
  return std::nullopt;
}

std::vector<std::string> SettingsFile::sub_folders() const {
  std::vector<std::string> folders;
  if (const auto prefix = find("DISPLAY", "PROGRAM_PREFIX")) folders.push_back(beside(*prefix));
  std::string_view list = find("RS274NGC", "SUBROUTINE_PATH").value_or("");
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(':'), list.size());
    if (end > 0) folders.push_back(beside(list.substr(0, end)));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return folders;
}

std::string SettingsFile::path_of(std::string_view section, std::string_view name) const {
  const auto text = find(section, name);
  return text && !text->empty() ? beside(*text) : std::string();
}

std::string SettingsFile::beside(std::string_view path) const {
  return file_in_folder(folder_, path);
}

}  // namespace passo
