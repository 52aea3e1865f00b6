#include "passo/sender/grbl_machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/sender/grbl_reply.hpp"
#include "passo/units/units.hpp"

namespace passo {
namespace {

constexpr std::size_t most_alarms = 256;
constexpr std::size_t most_messages = 50;
constexpr std::size_t blocks_of_a_mega = 30;      // at least; an Uno has 15
constexpr std::size_t blocks_beyond_a_mega = 60;  // at least: more than its memory holds
constexpr std::string_view extended_info = "$I+";

bool is_system(std::string_view name) {
  return name.size() >= 3 && name.starts_with("G5") && name[2] >= '4' && name[2] <= '9';
}

}  // namespace

bool is_grbl_greeting(std::string_view line) {
  return line.starts_with("Grbl ") || line.starts_with("GrblHAL ") || line.ends_with("for help]");
}

void GrblMachine::become(std::string_view name) {
  firmware = name;
  if (!has_told_axes_) axes = row().axes.substr(0, axes.size());
  note_sizes();
}

void GrblMachine::note_sizes() {
  if (told_bytes_ != 0) bytes = told_bytes_ - std::min(told_bytes_, row().unusable_bytes);
}

void GrblMachine::hear_greeting(std::string_view line) {
  asked_.clear();
  if (const GrblFirmware* const marked = marked_grbl_firmware(line)) become(marked->name);
}

void GrblMachine::hear_value_count(std::size_t count) {
  if (!has_told_axes_ && count > 0) axes = row().axes.substr(0, count);
}

std::vector<std::string> GrblMachine::take_questions() {
  if (std::exchange(asked_, firmware) == firmware) return {};
  // grblHAL that was built to look like Grbl names itself here alone.
  if (firmware == "grbl-Mega" && blocks >= blocks_beyond_a_mega) return {std::string(extended_info)};
  const std::span<const std::string_view> questions = row().questions;
  return {questions.begin(), questions.end()};
}

// grblHAL: kinematics/corexy.c. FluidNC and µCNC do not tell it in this form.
bool GrblMachine::is_core_xy() const {
  if (kinematics.starts_with("CoreXY")) return true;
  return row().tells_core_xy && options.find('C') != std::string::npos;
}

bool GrblMachine::measures_motors() const {
  return row().measures_motors && is_core_xy();
}

bool GrblMachine::tells_modes_unasked() const {
  const int bit = row().unasked_modes;
  if (bit <= 0) return bit == GrblFirmware::at_any_time;
  const auto found = settings.find(10);
  return found != settings.end() && (static_cast<int>(found->second) & bit) != 0;
}

bool GrblMachine::has_mist() const {
  return !row().tells_mist || options.empty() || options.find('M') != std::string::npos;
}

bool GrblMachine::has_option(std::string_view name) const {
  std::string_view rest = new_options;
  while (!rest.empty()) {
    std::string_view option = next_grbl_field(rest, ',');
    if (next_grbl_field(option, '=') == name) return true;
  }
  return false;
}

void GrblMachine::hear(std::string_view line) {
  if (line.starts_with('$')) return hear_setting(line);
  if (!line.starts_with('[') || !line.ends_with(']')) return;
  line = line.substr(1, line.size() - 2);
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view name = line.substr(0, colon);
  const std::string_view value = line.substr(colon + 1);
  if (name == "VER" || name == "VER+") {
    version = value.substr(0, value.find(':'));
    version.erase(version.find_last_not_of(' ') + 1);
    version.erase(0, version.find_first_not_of(' '));
    if (const GrblFirmware* const marked = marked_grbl_firmware(version)) become(marked->name);
  } else if (name == "FIRMWARE") {
    const GrblFirmware* const marked = marked_grbl_firmware(value);
    become(marked != nullptr ? marked->name : value);
  } else if (name == "OPT" || name == "OPT+") {
    hear_options(value);
  } else if (name == "NEWOPT") {
    new_options = value;
  } else if (name == "MSG") {
    if (messages_.size() < most_messages) messages_.emplace_back(value);
  } else if (name == "KINEMATICS") {
    kinematics = value;
  } else if (name == "AXS") {
    hear_axes(value);
  } else if (name == "ALARMCODE") {
    hear_alarm(value);
  } else if (name == "GC") {
    hear_modes(value);
  } else if (is_system(name) || name == "G28" || name == "G30" || name == "G92" || name == "TLO") {
    hear_offset(name, value);
  }
}

// "V,15,128": what it was built with, the planner's blocks, the bytes of the receive buffer. µCNC: "C3,16B,T1,15,128",
// first the kinematics and the number of axes.
void GrblMachine::hear_options(std::string_view told) {
  options = next_grbl_field(told, ',');
  if (row().sizes_are_last) {
    while (std::ranges::count(told, ',') > 1) static_cast<void>(next_grbl_field(told, ','));
    const std::size_t digit = options.find_last_not_of("0123456789") + 1;
    if (const auto count = read_grbl_number(std::string_view(options).substr(digit)); count && *count >= 1) {
      hear_value_count(static_cast<std::size_t>(std::min(*count, 9.0)));
    }
  }
  const auto told_blocks = read_grbl_number(next_grbl_field(told, ','));
  const auto told_bytes = read_grbl_number(next_grbl_field(told, ','));
  if (told_blocks && *told_blocks >= 1 && *told_blocks <= 10000) blocks = static_cast<std::size_t>(*told_blocks);
  if (told_bytes && *told_bytes >= 64 && *told_bytes <= 65536) told_bytes_ = static_cast<std::size_t>(*told_bytes);
  note_sizes();
  if (firmware == "Grbl" && blocks >= blocks_of_a_mega) become("grbl-Mega");
}

// "5:XYZAB". Only grbl-Mega-5X and grblHAL tell this, and grblHAL names itself.
void GrblMachine::hear_axes(std::string_view value) {
  const std::size_t colon = value.find(':');
  if (colon == std::string_view::npos || colon + 1 >= value.size()) return;
  axes = value.substr(colon + 1, axis_count);
  has_told_axes_ = true;
  if (firmware == "Grbl" || firmware == "grbl-Mega") become("grbl-Mega-5X");
}

// "10||EStop asserted. Clear and reset"
void GrblMachine::hear_alarm(std::string_view value) {
  const auto number = read_grbl_number(next_grbl_field(value, '|'));
  static_cast<void>(next_grbl_field(value, '|'));
  const bool is_number = number && *number >= 0 && *number < most_alarms;
  if (is_number && !value.empty()) alarms[static_cast<int>(*number)] = value;
}

// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0"
void GrblMachine::hear_modes(std::string_view modes) {
  while (!modes.empty()) {
    const std::string_view mode = next_grbl_field(modes, ' ');
    if (is_system(mode)) system = mode;
  }
}

void GrblMachine::hear_offset(std::string_view name, std::string_view value) {
  auto place = read_grbl_place(value, axes);
  if (!place) return;
  // Grbl and FluidNC tell the length of the tool, grblHAL tells three numbers.
  if (name == "TLO" && value.find(',') == std::string_view::npos) {
    (*place)[Axis::z] = std::exchange((*place)[Axis::x], 0.0);
  }
  offsets[std::string(name)] = millimetres(*place);
}

void GrblMachine::hear_setting(std::string_view line) {
  const std::string_view name = next_grbl_field(line, '=');
  const auto number = read_grbl_number(name.substr(1));
  const std::string_view text = line.substr(0, line.find(' '));
  const auto value = read_grbl_number(text);
  if (!number || std::abs(*number) >= 1e6 || !value) return;
  settings[static_cast<int>(*number)] = *value;
  setting_texts[static_cast<int>(*number)] = text;
}

bool GrblMachine::homes_single_axes() const {
  return row().homes_single_axes || (!row().sizes_are_last && options.find('H') != std::string::npos);
}

bool GrblMachine::in_inches() const {
  const auto found = settings.find(13);
  return found != settings.end() && found->second != 0;
}

Point GrblMachine::millimetres(Point reported) const {
  if (!in_inches()) return reported;
  for (const Axis axis : all_axes) {
    if (!is_rotary(axis) || row().converts_angles) reported[axis] *= mm_per_inch;
  }
  return reported;
}

std::optional<Point> GrblMachine::work_zero() const {
  if (!offsets.contains(system)) return {};
  Point zero;
  for (const std::string_view name : {std::string_view(system), std::string_view("G92"), std::string_view("TLO")}) {
    const auto found = offsets.find(std::string(name));
    if (found != offsets.end()) zero = zero + found->second;
  }
  return zero;
}

Point first_work_zero(const GrblMachine& machine) {
  Point zero;
  for (const char* name : {"G54", "G92"}) {
    const auto found = machine.offsets.find(name);
    if (found != machine.offsets.end()) zero = zero + found->second;
  }
  return zero;
}

}  // namespace passo
