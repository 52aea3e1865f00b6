#include "passo/sender/firmware_setting.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/sender/grbl_reply.hpp"

namespace passo {
namespace {

using Kind = FirmwareSetting::Kind;

constexpr std::size_t most_settings = 2000;
constexpr std::size_t longest_value = 200;

// The data types of grblHAL, by their number in $ES.
constexpr std::array kinds_of_grblhal = {Kind::flag,     Kind::bits,    Kind::bits,    Kind::choice,
                                         Kind::axes,     Kind::integer, Kind::number,  Kind::text,
                                         Kind::password, Kind::text,    Kind::integer, Kind::integer};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

// grblHAL writes line ends as \n, and separators inside a text as \|.
std::string plain(std::string_view text) {
  std::string words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      words += text[i];
    } else if (text[++i] != 'n') {
      words += text[i];
    } else if (!words.empty() && words.back() != ' ') {
      words += ' ';
    }
  }
  return std::string(trimmed(words));
}

std::vector<std::string> split(std::string_view text, char mark) {
  std::vector<std::string> parts;
  while (!text.empty()) parts.push_back(plain(next_grbl_field(text, mark)));
  return parts;
}

bool is_masked(std::string_view value) {
  return !value.empty() && value.find_first_not_of('*') == std::string_view::npos;
}

bool is_setting_name(std::string_view name) {
  return name.size() >= 2 && name.size() <= 60 && name.front() == '$' &&
         std::ranges::all_of(name.substr(1),
                             [](char letter) { return letter > ' ' && letter <= '~' && letter != '$'; });
}

std::string range_words(const FirmwareSetting& setting) {
  const std::string unit = setting.unit.empty() ? "" : " " + setting.unit;
  const char* const zero = setting.zero_too ? "0, or " : "";
  if (setting.least && setting.most) return fmt::format("{}{:g} to {:g}{}", zero, *setting.least, *setting.most, unit);
  if (setting.least) return fmt::format("{}at least {:g}{}", zero, *setting.least, unit);
  return fmt::format("at most {:g}{}", *setting.most, unit);
}

Failure<std::string> wrong(const FirmwareSetting& setting, std::string_view value, const std::string& expected) {
  const std::string title = setting.title.empty() ? "" : fmt::format(" ({})", setting.title);
  return Failure{
      fmt::format("{}={}: {}{} is {}", setting.name, shown_value(setting, value), setting.name, title, expected)};
}

// The highest value of a sum of bits; nothing if their number is not known.
std::optional<double> most_of(const FirmwareSetting& setting) {
  const bool is_sum = setting.kind == Kind::bits || setting.kind == Kind::axes;
  if (setting.choices.empty() || setting.choices.size() > 16) return setting.most;
  if (is_sum && !setting.most) return std::exp2(static_cast<double>(setting.choices.size())) - 1;
  if (setting.kind == Kind::choice) return static_cast<double>(setting.choices.size()) - 1;
  return setting.most;
}

}  // namespace

std::string_view name_of(FirmwareSetting::Kind kind) {
  constexpr std::array<std::string_view, 9> names = {"unknown", "number", "integer", "flag",    "bits",
                                                     "axes",    "choice", "text",    "password"};
  return names[static_cast<std::size_t>(kind)];
}

bool names_password(std::string_view name) {
  std::string lower(name);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower.find("password") != std::string::npos || lower.ends_with("/psk") || lower.ends_with("/token");
}

// Always as many asterisks, which do not tell the length.
std::string shown_value(const FirmwareSetting& setting, std::string_view value) {
  const bool is_hidden = setting.kind == Kind::password && !value.empty();
  return is_hidden ? "********" : std::string(value);
}

void SettingDescriptions::hear(std::string_view line) {
  if (line.starts_with("[SETTING:") && line.ends_with(']')) return hear_setting(line.substr(9, line.size() - 10));
  if (line.starts_with("[SETTINGGROUP:") && line.ends_with(']')) {
    std::string_view fields = line.substr(14, line.size() - 15);
    const std::string id(next_grbl_field(fields, '|'));
    static_cast<void>(next_grbl_field(fields, '|'));
    if (groups_.size() < most_settings) groups_[id] = plain(fields);
    return;
  }
  if (!line.empty() && line.front() >= '0' && line.front() <= '9') hear_table(line);
}

// "110|43|X-axis maximum rate|mm/min|6|#####0.000|||0|0": number, group, name, unit, data type, format, least, most,
// restart, zero allowed.
void SettingDescriptions::hear_setting(std::string_view fields) {
  const std::string name = fmt::format("${}", next_grbl_field(fields, '|'));
  if (settings_.size() >= most_settings && !settings_.contains(name)) return;
  FirmwareSetting& setting = settings_[name];
  setting.name = name;
  setting.group = next_grbl_field(fields, '|');
  setting.title = plain(next_grbl_field(fields, '|'));
  setting.unit = plain(next_grbl_field(fields, '|'));
  const auto kind = read_grbl_number(next_grbl_field(fields, '|'));
  const bool is_known = kind && *kind >= 0 && *kind < static_cast<double>(kinds_of_grblhal.size());
  setting.kind = is_known ? kinds_of_grblhal[static_cast<std::size_t>(*kind)] : Kind::unknown;
  const std::string_view format = next_grbl_field(fields, '|');
  const bool has_choices = setting.kind == Kind::bits || setting.kind == Kind::choice;
  if (has_choices) setting.choices = split(format, ',');
  for (std::string& choice : setting.choices) {
    if (choice == "N/A") choice.clear();
  }
  setting.least = read_grbl_number(next_grbl_field(fields, '|'));
  setting.most = read_grbl_number(next_grbl_field(fields, '|'));
  setting.needs_restart = next_grbl_field(fields, '|') == "1";
  setting.zero_too = fields == "1";
  // Of a text these are lengths.
  if (setting.kind == Kind::text || setting.kind == Kind::password) setting.least = setting.most = std::nullopt;
}

// A line of $ESH, separated by tabs: number, name, unit, data type, format, meaning …
void SettingDescriptions::hear_table(std::string_view line) {
  const auto found = settings_.find(fmt::format("${}", next_grbl_field(line, '\t')));
  if (found == settings_.end()) return;
  for (int i = 0; i < 4; ++i) static_cast<void>(next_grbl_field(line, '\t'));
  found->second.meaning = plain(next_grbl_field(line, '\t'));
}

bool SettingDescriptions::describe(FirmwareSetting& setting, std::string_view axes) const {
  const auto found = settings_.find(setting.name);
  if (found == settings_.end()) return false;
  std::string value = std::move(setting.value);
  setting = found->second;
  setting.value = std::move(value);
  const auto group = groups_.find(setting.group);
  setting.group = group == groups_.end() ? "" : group->second;
  if (setting.kind != Kind::axes) return true;
  for (const char letter : axes) setting.choices.emplace_back(1, letter);
  return true;
}

Status<std::string> check_setting(const FirmwareSetting& setting, std::string_view value) {
  if (setting.read_only) {
    return Failure{fmt::format("{} is in the board's YAML file, and cannot be written by its number", setting.name)};
  }
  const bool is_text = setting.kind == Kind::text || setting.kind == Kind::password || setting.kind == Kind::unknown;
  const bool is_printable = std::ranges::all_of(value, [](char letter) { return letter >= ' ' && letter <= '~'; });
  if (value.size() > longest_value || !is_printable) return wrong(setting, value, "a text of at most 200 characters");
  if (is_text) return Unit{};
  const auto number = read_grbl_number(value);
  if (!number) return wrong(setting, value, "a number");
  const bool is_whole = setting.kind != Kind::number;
  if (is_whole && *number != std::floor(*number)) return wrong(setting, value, "a whole number");
  FirmwareSetting bounds = setting;
  bounds.most = most_of(setting);
  if (is_whole && setting.kind != Kind::integer && !bounds.least) bounds.least = 0;
  if (setting.kind == Kind::flag) bounds.most = 1;
  const bool is_below = bounds.least && *number < *bounds.least && !(setting.zero_too && *number == 0);
  const bool is_above = bounds.most && *number > *bounds.most;
  if (is_below || is_above) return wrong(setting, value, range_words(bounds));
  return Unit{};
}

bool is_same_value(std::string_view a, std::string_view b) {
  const auto first = read_grbl_number(a);
  const auto second = read_grbl_number(b);
  if (!first || !second) return a == b;
  // Grbl writes three decimals of a float with seven digits.
  return std::abs(*first - *second) <= std::max(0.00051, 1e-6 * std::abs(*first));
}

std::string settings_text(const GrblMachine& machine, std::span<const FirmwareSetting> settings) {
  std::string text =
      fmt::format("; settings of {} {}\n[VER:{}:]\n", machine.firmware, machine.version, machine.version);
  if (machine.firmware != "Grbl") text += fmt::format("[FIRMWARE:{}]\n", machine.firmware);
  const std::string kinematics = machine.kinematics.empty() && machine.is_core_xy() ? "CoreXY" : machine.kinematics;
  if (!kinematics.empty()) text += fmt::format("[KINEMATICS:{}]\n", kinematics);
  text += fmt::format("[AXS:{}:{}]\n", machine.axes.size(), machine.axes);
  const bool hides = std::ranges::any_of(
      settings, [](const FirmwareSetting& one) { return one.kind == Kind::password && !one.value.empty(); });
  if (hides) text += "; passwords are not saved: write those with asterisks again after a restore\n";
  for (const FirmwareSetting& setting : settings) {
    text += fmt::format("{}={}\n", setting.name, shown_value(setting, setting.value));
  }
  return text;
}

Result<std::vector<NamedSetting>, std::string> parse_settings_text(std::string_view text) {
  std::vector<NamedSetting> settings;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::string_view line = trimmed(next_grbl_field(text, '\n'));
    const bool says_nothing = line.empty() || line == "ok" || line == "$$" || line.find_first_of("[;#(<") == 0;
    if (says_nothing) continue;
    const std::size_t equals = line.find('=');
    const std::string_view name = trimmed(line.substr(0, equals));
    if (equals == std::string_view::npos || !is_setting_name(name)) {
      return Failure{fmt::format("line {}: expected a setting such as $110=500", line_number)};
    }
    std::string_view value = trimmed(line.substr(equals + 1));
    // Older versions of Grbl add the meaning: "$110=500.000 (x max rate, mm/min)".
    if (const std::size_t meaning = value.find(" ("); meaning != std::string_view::npos && value.ends_with(')')) {
      value = trimmed(value.substr(0, meaning));
    }
    if (settings.size() >= most_settings) {
      return Failure{fmt::format("line {}: expected at most {} settings", line_number, most_settings)};
    }
    settings.push_back({.name = std::string(name), .value = std::string(value)});
  }
  if (settings.empty()) return Failure{std::string("expected at least one setting, such as $110=500")};
  return settings;
}

std::vector<SettingDifference> differences(std::span<const NamedSetting> file, std::span<const FirmwareSetting> board) {
  std::vector<SettingDifference> found;
  for (const NamedSetting& kept : file) {
    const auto here = std::ranges::find(board, kept.name, &FirmwareSetting::name);
    if (is_masked(kept.value)) continue;
    if (here == board.end()) {
      found.push_back({.name = kept.name, .in_file = kept.value, .on_board = ""});
    } else if (!is_same_value(kept.value, here->value) && !is_masked(here->value)) {
      found.push_back({.name = kept.name, .in_file = kept.value, .on_board = here->value});
    }
  }
  for (const FirmwareSetting& here : board) {
    const bool is_in_file = std::ranges::find(file, here.name, &NamedSetting::name) != file.end();
    if (!is_in_file) found.push_back({.name = here.name, .in_file = "", .on_board = here.value});
  }
  return found;
}

}  // namespace passo
