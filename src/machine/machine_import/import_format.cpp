// Which of the formats a text has.
#include <algorithm>
#include <array>

#include "source_text.hpp"

namespace passo {
namespace {

struct FormatRow {
  ImportFormat format;
  std::string_view name;
};
constexpr std::array<FormatRow, 4> format_rows = {{{ImportFormat::settings, "settings"},
                                                   {ImportFormat::fluidnc, "fluidnc"},
                                                   {ImportFormat::linuxcnc, "linuxcnc"},
                                                   {ImportFormat::mach3, "mach3"}}};

bool is_setting(std::string_view line) {
  const std::size_t end = line.find_first_not_of("0123456789", 1);
  return line.size() > 2 && line.front() == '$' && end != std::string_view::npos && end > 1 &&
         without_blanks(line.substr(end)).starts_with('=');
}

bool is_section(std::string_view line) {
  constexpr std::array<std::string_view, 7> sections = {"[EMC]", "[KINS]", "[TRAJ]", "[EMCMOT]", "[HAL]", "[JOINT_0]", "[AXIS_"};
  return std::ranges::any_of(sections, [&](std::string_view section) { return line.starts_with(section); });
}

bool is_fluidnc_key(std::string_view line) {
  constexpr std::array<std::string_view, 4> keys = {"axes:", "steps_per_mm:", "stepping:", "max_rate_mm_per_min:"};
  return std::ranges::any_of(keys, [&](std::string_view key) { return line.starts_with(key); });
}

}  // namespace

std::string_view name_of(ImportFormat format) {
  return std::ranges::find(format_rows, format, &FormatRow::format)->name;
}

std::optional<ImportFormat> import_format_of(std::string_view name) {
  const auto row = std::ranges::find(format_rows, name, &FormatRow::name);
  if (row == format_rows.end()) return std::nullopt;
  return row->format;
}

std::optional<ImportFormat> detect_import_format(std::string_view text) {
  constexpr std::size_t most_looked_at = 20'000;  // lines
  SourceLines lines(text);
  std::string_view line;
  while (lines.number() < most_looked_at && lines.next(line)) {
    line = without_blanks(line);
    if (line.starts_with("<profile>") || line.starts_with("<Preferences>") ||
        (line.starts_with("<?xml") && text.substr(0, 4096).find("<profile") != std::string_view::npos)) {
      return ImportFormat::mach3;
    }
    while (!line.empty() && (line.front() == '<' || line.front() == '>')) line = without_blanks(line.substr(1));
    if (is_setting(line)) return ImportFormat::settings;
    if (is_section(line)) return ImportFormat::linuxcnc;
    if (is_fluidnc_key(line)) return ImportFormat::fluidnc;
  }
  return std::nullopt;
}

}  // namespace passo
