#include "passo/interpreter/settings_file.hpp"

#include <filesystem>

#include "file_fields.hpp"
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

}  // namespace

bool SettingsFile::read(const std::string& path, Diagnostics& diagnostics) {
  *this = {};
  Result<ProgramReader, Diagnostic> reader = ProgramReader::open(path);
  if (!reader) {
    Diagnostic problem = reader.error();
    if (problem.code == "file.empty") return true;
    problem.expected = "settings in ini form: [SECTION] and NAME = VALUE";
    diagnostics.add(std::move(problem));
    return false;
  }
  folder_ = std::filesystem::path(path).parent_path().string();
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
      fields.error("settings.bad-line", line, fmt::format("{} is no setting", quoted(line.text)), "NAME = VALUE");
    } else if (!set(section, name, without_comment(trimmed(line.text.substr(equals + 1))))) {
      fields.error("settings.too-many", line, fmt::format("more than {} settings", most_settings), "a shorter file");
      break;
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

std::optional<double> SettingsFile::parameter(std::string_view parameter) const {
  constexpr std::string_view opening = "_ini[";
  const std::size_t close = parameter.find(']');
  if (!parameter.starts_with(opening) || close == std::string_view::npos) return std::nullopt;
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
  return (std::filesystem::path(folder_) / path).string();
}

}  // namespace passo
