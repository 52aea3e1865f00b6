#include "passo/grbl/grbl_enumerations.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "passo/activity/machine_fault.hpp"
#include "passo/grbl_meanings/firmware_setting_table.hpp"
#include "passo/grbl_meanings/grbl_meanings.hpp"

namespace passo {
namespace {

using Kind = FirmwareSetting::Kind;

constexpr int reports_mask = 10;
constexpr int reports_in_inches = 13;
constexpr int first_of_axes = 100;

// A group of settings, with grblHAL's number.
struct Group {
  int number = 0;
  int parent = 0;
  std::string_view title;
  std::string_view in_table;  // the group in the table of settings
};
constexpr std::array groups = {Group{0, 0, "Root", ""},          Group{1, 0, "General", "Reports"},
                               Group{1, 0, "General", "Motion"}, Group{2, 0, "Control signals", "Inputs"},
                               Group{3, 0, "Limits", "Limits"},  Group{6, 0, "Spindle", "Spindle"},
                               Group{11, 0, "Homing", "Homing"}, Group{35, 0, "Stepper", "Motors"},
                               Group{42, 0, "Axis", "Axis"}};
constexpr int general = 1;
constexpr int axis_group = 42;  // that of the first axis follows

struct AlarmWords {
  GrblAlarm alarm;
  std::string_view words;
};
constexpr std::array alarms = {
    AlarmWords{GrblAlarm::hard_limit,
               "A limit switch or the emergency stop has stopped the motors at once. The position is lost: home the "
               "machine."},
    AlarmWords{GrblAlarm::soft_limit,
               "The line would leave the travel. The machine has braked, and its position is known: unlock it."},
    AlarmWords{GrblAlarm::lost_place,
               "The position is lost: home the machine, or jog it to a known position and unlock it."},
    AlarmWords{GrblAlarm::probe_before,
               "The probe was triggered before the probe move, or open before G38.4 or G38.5."},
    AlarmWords{GrblAlarm::probe_untouched, "The probe did not touch within the move."},
    AlarmWords{GrblAlarm::homing_stopped, "Homing was stopped."},
    AlarmWords{GrblAlarm::homing_no_release, "Homing could not move off a limit switch. Check its wiring and $27."},
    AlarmWords{GrblAlarm::homing_no_switch, "Homing found no limit switch. Check the wiring and the travel."},
    AlarmWords{GrblAlarm::motor_fault, "A motor driver reports a fault."},
};

// grblHAL's number of a datatype.
int datatype_of(Kind kind) {
  switch (kind) {
    case Kind::flag: return 0;
    case Kind::bits: return 1;
    case Kind::choice: return 3;
    case Kind::axes: return 4;
    case Kind::integer: return 5;
    default: return 6;
  }
}

std::string format_of(const FirmwareSetting& setting) {
  std::string text;
  switch (setting.kind) {
    case Kind::flag:
    case Kind::axes: return text;
    case Kind::integer: return "#####0";
    case Kind::bits:
    case Kind::choice: break;
    default: return "#####0.000";
  }
  for (const std::string& choice : setting.choices) text += (text.empty() ? "" : ",") + choice;
  return text;
}

int group_of(const FirmwareSetting& setting, int number) {
  if (number >= first_of_axes) return axis_group + 1 + number % 10;
  const auto* const found = std::ranges::find(groups, setting.group, &Group::in_table);
  return found == groups.end() || setting.group.empty() ? general : found->number;
}

std::string line_of(const GrblSetting& given, std::string_view axes, bool is_kept) {
  FirmwareSetting setting{.name = fmt::format("${}", given.number), .value = given.value};
  describe_by_table(setting, axes);
  const bool is_range = setting.kind == Kind::integer || setting.kind == Kind::number;
  const auto bound = [&](const std::optional<double>& value) {
    return is_range && value ? fmt::format("{:g}", *value) : std::string();
  };
  const bool is_choice = given.number == reports_mask || given.number == reports_in_inches;
  return fmt::format("[SETTING:{}|{}|{}|{}|{}|{}|{}|{}|{}|0]\r\n", given.number, group_of(setting, given.number),
                     setting.title.empty() ? setting.name : setting.title, setting.unit, datatype_of(setting.kind),
                     format_of(setting), bound(setting.least), bound(setting.most), is_kept && !is_choice ? 1 : 0);
}

std::string text_of_groups(std::string_view axes) {
  std::string text;
  int last = -1;
  for (const Group& group : groups) {
    if (group.number == last) continue;
    last = group.number;
    text += fmt::format("[SETTINGGROUP:{}|{}|{}]\r\n", group.number, group.parent, group.title);
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    text += fmt::format("[SETTINGGROUP:{}|{}|{}-axis]\r\n", axis_group + 1 + static_cast<int>(i), axis_group, axes[i]);
  }
  return text;
}

std::string text_of_alarms() {
  std::string text;
  for (const AlarmWords& one : alarms) {
    text += fmt::format("[ALARMCODE:{}||{}]\r\n", static_cast<int>(one.alarm), one.words);
  }
  return text;
}

// The words are clauses.
std::string text_of_errors() {
  std::string text;
  for (const GrblMeaning& one : grbl_errors()) {
    std::string words(one.words);
    if (words.front() >= 'a' && words.front() <= 'z') words.front() = static_cast<char>(words.front() - 'a' + 'A');
    text += fmt::format("[ERRORCODE:{}||{}.]\r\n", one.number, words);
  }
  return text;
}

}  // namespace

std::optional<std::string> grbl_enumeration(std::string_view command, std::span<const GrblSetting> settings,
                                            std::string_view axes, bool is_kept) {
  if (command == "$EG") return text_of_groups(axes);
  if (command == "$EA") return text_of_alarms();
  if (command == "$EE") return text_of_errors();
  if (command != "$ES") return {};
  std::string text;
  for (const GrblSetting& setting : settings) text += line_of(setting, axes, is_kept);
  return text;
}

}  // namespace passo
