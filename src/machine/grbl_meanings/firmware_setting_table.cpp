// The settings of Grbl 1.1 and of the firmwares that use its numbers. Source: Grbl v1.1 Settings
// (doc/markdown/settings.md of gnea/grbl); settings.c of grbl-Mega-5X for the axes beyond Z.
#include "passo/grbl_meanings/firmware_setting_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "passo/geometry/axes.hpp"

namespace passo {
namespace {

using Kind = FirmwareSetting::Kind;

struct SettingRow {
  int number = 0;
  std::string_view title;
  std::string_view unit;
  std::string_view group;
  Kind kind = Kind::number;
  std::optional<double> least = {};
  std::optional<double> most = {};
  std::string_view meaning = {};
  bool needs_restart = false;
};

constexpr double byte = 255;
constexpr double word = 65535;

constexpr std::array rows = {
    SettingRow{0, "Step pulse", "us", "Motors", Kind::integer, 3, byte,
               "Length of a step pulse. The driver's data sheet gives the least"},
    SettingRow{1, "Idle delay", "ms", "Motors", Kind::integer, 0, byte,
               "Time from standstill until the drivers are disabled. 255 keeps them enabled"},
    SettingRow{2, "Step inversion", "", "Motors", Kind::axes, 0, byte, "Axes whose step pulses are active low"},
    SettingRow{3, "Direction inversion", "", "Motors", Kind::axes, 0, byte, "Axes that move in the opposite direction"},
    SettingRow{4, "Enable inversion", "", "Motors", Kind::flag, 0, 1, "1: the drivers are enabled by a high level",
               true},
    SettingRow{5, "Limit inversion", "", "Inputs", Kind::flag, 0, 1, "1: a limit switch is closed at a high level",
               true},
    SettingRow{6, "Probe inversion", "", "Inputs", Kind::flag, 0, 1, "1: the probe touches at a high level", true},
    SettingRow{10, "Status reports", "", "Reports", Kind::bits, 0, byte, "Content of the status reports"},
    SettingRow{11,
               "Junction deviation",
               "mm",
               "Motion",
               Kind::number,
               0,
               {},
               "How fast corners are passed: a larger value is faster, and shakes more"},
    SettingRow{12, "Arc tolerance", "mm", "Motion", Kind::number, 0, {}, "Deviation of the chords that replace an arc"},
    SettingRow{13, "Reports in inches", "", "Reports", Kind::flag, 0, 1,
               "1: positions and feeds are reported in inches"},
    SettingRow{20, "Soft limits", "", "Limits", Kind::flag, 0, 1,
               "1: a motion that would leave the travel is refused. Needs homing"},
    SettingRow{21, "Hard limits", "", "Limits", Kind::flag, 0, 1, "1: a limit switch that closes stops the machine"},
    SettingRow{22, "Homing", "", "Homing", Kind::flag, 0, 1,
               "1: the machine has limit switches, and must be homed first"},
    SettingRow{23, "Homing direction", "", "Homing", Kind::axes, 0, byte, "Axes whose switch is at the lower end"},
    SettingRow{24, "Homing feed", "mm/min", "Homing", Kind::number, 0.001, {}, "Speed of the second, exact approach"},
    SettingRow{25, "Homing search", "mm/min", "Homing", Kind::number, 0.001, {}, "Speed of the first approach"},
    SettingRow{26, "Homing debounce", "ms", "Homing", Kind::integer, 0, word, "Time for a switch to become stable"},
    SettingRow{27, "Homing pull-off", "mm", "Homing", Kind::number, 0, {}, "Distance from the switches after homing"},
    SettingRow{30, "Highest spindle speed", "rpm", "Spindle", Kind::number, 0, {}, "Speed at the full output"},
    SettingRow{31, "Lowest spindle speed", "rpm", "Spindle", Kind::number, 0, {}, "Speed at the lowest output"},
    SettingRow{32, "Laser mode", "", "Spindle", Kind::flag, 0, 1,
               "1: the power follows the speed, and S changes while moving"},
};

struct SettingOfEachAxis {
  int first = 0;  // setting of the first axis
  std::string_view title;
  std::string_view unit;
  double least = 0;
  std::string_view meaning;
};
constexpr std::array axis_rows = {
    SettingOfEachAxis{100, "Steps", "steps/mm", 0.001, "Steps of the motor for a millimetre, or for a degree"},
    SettingOfEachAxis{110, "Maximum rate", "mm/min", 0.001, "Highest speed, also of rapids"},
    SettingOfEachAxis{120, "Acceleration", "mm/s2", 0.001, "Acceleration"},
    SettingOfEachAxis{130, "Travel", "mm", 0,
                      "Travel from the limit switch, for soft limits and for the search of homing"},
};

void describe_axis(FirmwareSetting& setting, int number, std::string_view axes) {
  const auto row = std::ranges::find_if(
      axis_rows, [number](const SettingOfEachAxis& one) { return number >= one.first && number < one.first + 10; });
  const auto index = static_cast<std::size_t>(number % 10);
  if (row == axis_rows.end() || index >= axes.size()) return;
  const char letter = axes[index];
  const auto axis = axis_of(letter);
  setting.title = fmt::format("{} of {}", row->title, letter);
  setting.group = fmt::format("Axis {}", letter);
  setting.unit = row->unit;
  if (const std::size_t mm = setting.unit.find("mm"); axis && is_rotary(*axis) && mm != std::string::npos) {
    setting.unit.replace(mm, 2, "deg");
  }
  setting.kind = Kind::number;
  setting.least = row->least;
  setting.meaning = row->meaning;
}

}  // namespace

std::optional<int> read_setting_number(std::string_view name) {
  int number = 0;
  if (!name.starts_with('$')) return {};
  const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size() || number < 0) return {};
  return number;
}

void describe_by_table(FirmwareSetting& setting, std::string_view axes) {
  const auto number = read_setting_number(setting.name);
  if (!number) return;
  if (*number >= 100) return describe_axis(setting, *number, axes);
  const auto* const row = std::ranges::find(rows, *number, &SettingRow::number);
  if (row == rows.end()) return;
  setting.title = row->title;
  setting.unit = row->unit;
  setting.group = row->group;
  setting.kind = row->kind;
  setting.least = row->least;
  setting.most = row->most;
  setting.meaning = row->meaning;
  setting.needs_restart = row->needs_restart;
  if (row->kind == Kind::bits) setting.choices = {"machine position", "buffer state"};
  if (row->kind != Kind::axes) return;
  for (const char letter : axes) setting.choices.emplace_back(1, letter);
}

}  // namespace passo
