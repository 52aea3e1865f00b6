// The settings of Grbl 1.1, grblHAL and FluidNC.
//
// Grbl: github.com/gnea/grbl, doc/markdown/settings.md. grblHAL: settings.h and config.h of its core. The levels of
// inputs and of the drivers' enable have opposite meanings in the two: Grbl's $5=0 is a switch that connects its pin to
// ground when it is pressed, grblHAL's $5=0 one that opens.
#include <algorithm>
#include <array>
#include <vector>

#include "format_imports.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

enum class GrblFirmware : std::uint8_t { grbl, grblhal, fluidnc };

struct SettingReason {
  int first;
  int last;
  const char* reason;
};
constexpr SettingReason setting_reasons[] = {
    {1, 1, "the drivers stay enabled while a program is connected; see drivers_off_after_s in [outputs]"},
    {7, 7, "no equivalent: when the spindle's PWM is off"},
    {8, 8, "which axes have two motors is not among the settings: see [axis.X.second_motor]"},
    {9, 9, "no equivalent: when the spindle's PWM is off"},
    {10, 10, "no equivalent: the content of status reports"},
    {11, 11, "no equivalent: Passo rounds corners within path_tolerance_mm"},
    {12, 12, "no equivalent: Passo follows arcs without chords"},
    {13, 13, "no equivalent: the unit of reports; all settings are in millimetres"},
    {17, 19, "no equivalent: the boards of Passo have their own pull-up resistors"},
    {21, 21, "no equivalent: a machine file has no key for hard limits"},
    {26, 26, "no equivalent: see filter_us in [inputs]"},
    {28, 28, "no equivalent: the retract of G73"},
    {31, 31, "no equivalent: the lowest spindle speed"},
    {33, 36, "no equivalent: the PWM of the spindle"},
    {37, 37, "no equivalent: all drivers are enabled together"},
    {38, 38, "pulses per revolution of the spindle's encoder: see encoder_counts_per_turn in [spindle]"},
    {39, 43, "no equivalent"},
    {50, 69, "no equivalent"},
    {70, 79, "no equivalent: the network of the controller"},
    {80, 96, "no equivalent: the controller of the spindle"},
    {140, 149, "no equivalent: the current is set at the driver"},
    {150, 159, "the microsteps are part of the steps per millimetre"},
    {170, 179, "the offset of two limit switches: measure it, see square_mm in [axis.X.second_motor]"},
    {180, 199, "no equivalent: the speeds of homing of single axes are not in use"},
    {200, 289, "no equivalent: the driver chips"},
    {300, 337, "no equivalent: the network of the controller"},
    {338, 339, "no equivalent: the driver chips"},
    {341, 346, "no equivalent: the tool change"},
    {350, 369, "no equivalent: the height control of a plasma torch"},
    {394, 394, "a fixed time: see run_up_s in [spindle], the time from standstill to 1000 rpm"},
};

std::string reason_of_setting(int number) {
  const auto row = std::ranges::find_if(setting_reasons,
                                        [&](const SettingReason& r) { return number >= r.first && number <= r.last; });
  return row == std::end(setting_reasons) ? "" : row->reason;
}

class SettingsImport {
 public:
  SettingsImport(const SourceNode& tree, ImportContext& context, ImportedModel& model)
      : tree_(tree), context_(context), model_(model) {}

  void import();

 private:
  // The last value counts, as in the controller.
  const SourceNode* setting(int number) const { return found(fmt::format("${}", number)); }
  const SourceNode* found(const std::string& name) const {
    const auto last = std::ranges::find(tree_.children.rbegin(), tree_.children.rend(), name, &SourceNode::name);
    return last == tree_.children.rend() ? nullptr : &*last;
  }
  std::optional<SourcedNumber> number(int setting_number, UnitFactor unit = {}) {
    return context_.number(setting(setting_number), fmt::format("${}", setting_number), unit);
  }
  std::optional<SourcedNumber> optional_number(int setting_number, UnitFactor unit = {}) {
    return context_.optional_number(setting(setting_number), fmt::format("${}", setting_number), unit);
  }
  std::optional<unsigned> mask(int number) { return context_.mask(setting(number), fmt::format("${}", number)); }
  ValueOrigin origin(int number) const { return context_.origin(*setting(number), fmt::format("${}", number)); }
  bool is_grblhal() const { return firmware_ == GrblFirmware::grblhal; }

  void find_firmware();
  void find_kinematics();
  void check_core_xy();
  void find_letters();
  void read_axis(Axis axis, int index);
  void read_travel(ImportedAxis& axis, int index);
  void read_second(ImportedAxis& axis, int index);
  void read_home(ImportedAxis& axis, int index);
  void read_homing_turn(ImportedHome& home, int index);
  void read_levels();
  void read_control_levels();
  void read_coolant_and_spindle_levels();
  void set_level(ImportedPin pin, int number, bool high) { model_.pin(pin) = SourcedFlag{high, origin(number)}; }
  std::optional<bool> same_for_all(int number);
  void read_spindle();
  void read_soft_limits();
  void list_rest();

  const SourceNode& tree_;
  ImportContext& context_;
  ImportedModel& model_;
  GrblFirmware firmware_ = GrblFirmware::grbl;
  std::vector<Axis> letters_;  // of the axes 0, 1, 2…
  unsigned homing_ = 0;        // $22
};

void SettingsImport::find_firmware() {
  const SourceNode* version = found("VER");
  const SourceNode* firmware = found("FIRMWARE");
  const auto says = [](const SourceNode* node, std::string_view word) {
    return node != nullptr && node->text.find(word) != std::string::npos;
  };
  constexpr std::array only_grblhal = {8, 9, 14, 15, 16, 17, 18, 19, 28, 29, 37, 39, 43, 44, 62};
  if (says(version, "FluidNC") || says(firmware, "FluidNC")) {
    firmware_ = GrblFirmware::fluidnc;
  } else if (says(firmware, "grblHAL") ||
             std::ranges::count_if(only_grblhal, [&](int n) { return setting(n) != nullptr; }) >= 3) {
    firmware_ = GrblFirmware::grblhal;
  }
  model_.runs_on_uno = firmware_ == GrblFirmware::grbl;
  context_.result().controller = is_grblhal() ? "grblHAL" : firmware_ == GrblFirmware::fluidnc ? "FluidNC" : "Grbl";
  model_.name = {context_.result().controller + " machine",
                 {.key = {}, .value = {}, .reason = "settings have no name"}};
  for (const SourceNode& node : tree_.children) {
    if (!node.name.starts_with('$')) context_.mark(node);
  }
  find_kinematics();
}

// grblHAL tells [KINEMATICS:CoreXY v2.02], and both have C in the first field of [OPT:VC,15,128].
void SettingsImport::find_kinematics() {
  const SourceNode* kinematics = found("KINEMATICS");
  const SourceNode* options = found("OPT");
  if (kinematics != nullptr && !kinematics->text.starts_with("CoreXY")) {
    context_.error("import.kinematics", context_.origin(*kinematics, "KINEMATICS"),
                   fmt::format("the machine has the kinematics {}", ImportContext::printable(kinematics->text)),
                   "CoreXY, or a machine with a motor, or two, for each axis: a machine file describes no others");
  } else if (kinematics != nullptr) {
    model_.core_xy = context_.origin(*kinematics, "KINEMATICS");
  } else if (options != nullptr && firmware_ != GrblFirmware::fluidnc &&
             options->text.substr(0, options->text.find(',')).find('C') != std::string::npos) {
    model_.core_xy = context_.origin(*options, "OPT");
  }
}

// The motors of X and Y are theirs together.
void SettingsImport::check_core_xy() {
  std::vector<ImportedAxis*> shared;
  for (ImportedAxis& axis : model_.axes) {
    if (axis.axis != Axis::x && axis.axis != Axis::y) continue;
    shared.push_back(&axis);
    if (axis.second) context_.unmapped(axis.second->origin, "a machine file has two motors for X and Y of a CoreXY");
    if (axis.backlash) context_.unmapped(axis.backlash->origin, "no equivalent for an axis of a CoreXY");
    axis.second.reset();
    axis.backlash.reset();
  }
  const bool have_scales = shared.size() == 2 && shared[0]->scale && shared[1]->scale;
  if (have_scales && shared[0]->scale->value.value() != shared[1]->scale->value.value()) {
    context_.error("import.kinematics", shared[1]->scale->origin,
                   fmt::format("X has {} steps per mm and Y has {}", shared[0]->scale->value.text(),
                               shared[1]->scale->value.text()),
                   "the same number for X and Y, which share the two motors of a CoreXY");
  }
  context_.warn(
      "the machine is a CoreXY: only its own board with Grbl can drive it. $110, $111, $120 and $121 are limits of its "
      "motors");
}

// "3:XYZ" in the line [AXS:3:XYZ]; without it, Grbl's order.
void SettingsImport::find_letters() {
  letters_ = {Axis::x, Axis::y, Axis::z, Axis::a, Axis::b, Axis::c, Axis::u, Axis::v, Axis::w};
  const SourceNode* axes = found("AXS");
  if (axes == nullptr) return;
  std::vector<Axis> given;
  for (const char letter : axes->text.substr(std::min(axes->text.find(':') + 1, axes->text.size()))) {
    const auto axis = axis_of(letter);
    if (!axis || std::ranges::count(given, *axis) > 0) return;
    given.push_back(*axis);
  }
  if (!given.empty()) letters_ = given;
}

void SettingsImport::read_axis(Axis letter, int index) {
  ImportedAxis axis{.axis = letter};
  axis.scale = number(100 + index);
  axis.velocity = number(110 + index, {1, 60});
  axis.acceleration = number(120 + index);
  read_travel(axis, index);
  if (is_grblhal()) axis.backlash = optional_number(160 + index);
  if (const auto reversed = mask(3)) axis.inverted = SourcedFlag{(*reversed >> index & 1U) != 0, origin(3)};
  if (const auto level = mask(5)) {
    axis.limit_high = SourcedFlag{is_grblhal() ? (*level >> index & 1U) == 0 : *level != 0, origin(5)};
  }
  if (is_grblhal()) read_second(axis, index);
  read_home(axis, index);
  if (is_rotary(letter) && is_grblhal()) {
    const auto rotary = mask(376);
    const int bit = static_cast<int>(index_of(letter)) - 3;
    if (rotary && (*rotary >> bit & 1U) == 0) {
      context_.warn(
          fmt::format("axis {} is a linear axis for the controller ($376), but a machine file has it in degrees",
                      letter_of(letter)));
    }
  }
  model_.axes.push_back(std::move(axis));
}

// Machine zero is at the switch at the high end, even if the machine homes to the low end; grblHAL can have it there.
// Without homing it is where the machine was switched on, which may be anywhere.
void SettingsImport::read_travel(ImportedAxis& axis, int index) {
  auto length = number(130 + index);
  if (!length) return;
  length->value = length->value.magnitude();
  if (length->value.value() == 0) {
    context_.unmapped(length->origin, "0: no soft limit");
    return;
  }
  const bool homes_low = (mask(23).value_or(0) >> index & 1U) != 0;
  const bool starts_at_zero = is_grblhal() && (homing_ & 9U) == 9U && homes_low;
  const SourcedNumber zero{DecimalNumber(0), length->origin};
  const bool is_anywhere = setting(22) != nullptr && (homing_ & 1U) == 0;
  axis.low = starts_at_zero ? zero : SourcedNumber{-length->value, length->origin};
  axis.high = starts_at_zero || is_anywhere ? *length : zero;
}

void SettingsImport::read_second(ImportedAxis& axis, int index) {
  const SourceNode* offset = setting(170 + index);
  const auto reversed = mask(8).value_or(0);
  const bool is_reversed = (reversed >> index & 1U) != 0;
  if (offset == nullptr && !is_reversed) return;
  const int number = offset != nullptr ? 170 + index : 8;
  axis.second = ImportedSecondMotor{.origin = origin(number)};
  const bool first = axis.inverted && axis.inverted->value;
  if (setting(8) != nullptr) axis.second->inverted = SourcedFlag{first != is_reversed, origin(8)};
  axis.second->limit_high = axis.limit_high;
  context_.warn(fmt::format("axis {} has two motors: check [axis.{}.second_motor], and measure its square_mm",
                            letter_of(axis.axis), letter_of(axis.axis)));
}

void SettingsImport::read_home(ImportedAxis& axis, int index) {
  if ((homing_ & 1U) == 0) return;
  const bool own_speeds = is_grblhal() && (homing_ & 512U) != 0;
  auto latch = optional_number(own_speeds ? 180 + index : 24, {1, 60});
  auto seek = optional_number(own_speeds ? 190 + index : 25, {1, 60});
  auto pull_off = optional_number(27);
  const auto directions = mask(23);
  if (!latch || !seek || !directions || !axis.low || !axis.high) {
    context_.warn(fmt::format("axis {} is not homed by the machine file: it needs $23, $24, $25 and ${}",
                              letter_of(axis.axis), 130 + index));
    return;
  }
  const bool high = (*directions >> index & 1U) == 0;
  ImportedHome home{.is_high = {high, origin(23)},
                    .switch_at = high ? *axis.high : *axis.low,
                    .seek = *seek,
                    .latch = *latch,
                    .pull_off = pull_off,
                    .turn = -1};
  if (is_grblhal() && setting(44) != nullptr) {
    read_homing_turn(home, index);
    if (home.turn < 0) {
      context_.warn(fmt::format("axis {} is in none of the homing cycles $44 to $49", letter_of(axis.axis)));
      return;
    }
  }
  axis.home = std::move(home);
}

void SettingsImport::read_homing_turn(ImportedHome& home, int index) {
  for (int cycle = 0; cycle < 6; ++cycle) {
    const auto axes = mask(44 + cycle);
    if (!axes || (*axes >> index & 1U) == 0) continue;
    home.turn = cycle;
    home.turn_origin = origin(44 + cycle);
    return;
  }
}

// A bit of a mask, if it is the same for all axes of the machine. Otherwise the setting is listed.
std::optional<bool> SettingsImport::same_for_all(int number) {
  const auto bits = mask(number);
  if (!bits) return std::nullopt;
  const auto count = static_cast<unsigned>(model_.axes.size());
  const unsigned all = (1U << count) - 1;
  const unsigned set = *bits & all;
  if (set == 0 || set == all) return set != 0;
  // One enable for all drivers follows the bit of X.
  if (number == 4) return (set & 1U) != 0;
  context_.unmapped(origin(number), "the axes have different levels, a machine file has one for all");
  return std::nullopt;
}

void SettingsImport::read_levels() {
  if (firmware_ == GrblFirmware::fluidnc) return;
  if (const auto inverted = same_for_all(2)) set_level(ImportedPin::step, 2, !*inverted);
  if (is_grblhal()) {
    if (const auto inverted = same_for_all(4)) set_level(ImportedPin::driver_enable, 4, !*inverted);
    if (const auto inverted = mask(6)) set_level(ImportedPin::probe, 6, (*inverted & 1U) == 0);
    read_control_levels();
    read_coolant_and_spindle_levels();
    return;
  }
  if (const auto inverted = mask(4)) set_level(ImportedPin::driver_enable, 4, *inverted != 0);
  if (const auto inverted = mask(6)) set_level(ImportedPin::probe, 6, *inverted != 0);
}

// [SIGNALS:HSE] tells which of the inputs the controller has. An input that is not wired must not become active high.
void SettingsImport::read_control_levels() {
  const auto inverted = mask(14);
  if (!inverted) return;
  const SourceNode* signals = found("SIGNALS");
  if (signals == nullptr) {
    context_.unmapped(origin(14), "which of these inputs exist is only in the answer to $I");
    return;
  }
  struct Control {
    char letter;
    unsigned bit;
    ImportedPin pin;
  };
  constexpr std::array<Control, 4> controls = {{{'H', 1, ImportedPin::feed_hold},
                                                {'S', 2, ImportedPin::cycle_start},
                                                {'D', 3, ImportedPin::door},
                                                {'E', 6, ImportedPin::emergency_stop}}};
  for (const Control& control : controls) {
    if (signals->text.find(control.letter) != std::string::npos) {
      set_level(control.pin, 14, (*inverted >> control.bit & 1U) == 0);
    }
  }
}

void SettingsImport::read_coolant_and_spindle_levels() {
  if (const auto coolant = mask(15)) {
    set_level(ImportedPin::flood, 15, (*coolant & 1U) == 0);
    set_level(ImportedPin::mist, 15, (*coolant & 2U) == 0);
  }
  const auto spindle = mask(16);
  if (!spindle) return;
  set_level(ImportedPin::spindle_reverse, 16, (*spindle & 2U) == 0);
  if (((*spindle & 1U) != 0) == ((*spindle & 4U) != 0)) {
    set_level(ImportedPin::spindle, 16, (*spindle & 1U) == 0);
  } else {
    context_.unmapped(origin(16), "the relay and the PWM of the spindle have different levels");
  }
}

void SettingsImport::read_spindle() {
  model_.step_pulse_us = optional_number(0);
  model_.max_rpm = optional_number(30);
  if (is_grblhal()) {
    model_.direction_setup_us = optional_number(29);
    model_.enable_wait_s = optional_number(680, {1, 1000});
  }
  const auto mode = mask(32);
  if (!mode) return;
  context_.unmapped(origin(32), *mode == 1 ? "no equivalent: laser mode" : "no equivalent");
  if (*mode == 1) context_.warn("the controller drives a laser ($32=1): Passo treats it as a spindle");
  if (*mode == 2)
    context_.warn("the controller is in lathe mode ($32=2): Passo derives a lathe from its axes, X and Z");
}

void SettingsImport::read_soft_limits() {
  if (const auto on = mask(20)) {
    context_.understood(origin(20), "the travel of each axis, which Passo always enforces");
    if (*on == 0) {
      context_.warn("the soft limits of the controller are off ($20=0), so its travel may be wrong; Passo enforces it");
    }
  }
  if (setting(22) != nullptr)
    context_.understood(origin(22), (homing_ & 1U) != 0 ? "[axis.X.home]" : "no [axis.X.home]");
  if ((homing_ & 1U) != 0) return;
  if (setting(22) != nullptr)
    context_.warn(
        "homing is off ($22=0): machine zero is where the machine is switched on, so the file allows the whole travel "
        "in "
        "both directions from there, and Passo cannot know where it ends");
  for (const int number : {23, 24, 25, 27}) {
    context_.unmapped(setting(number), fmt::format("${}", number), "homing is off ($22)");
  }
}

void SettingsImport::list_rest() {
  for (const SourceNode& node : tree_.children) {
    if (!node.name.starts_with('$')) continue;
    int number = 0;
    for (const char digit : node.name.substr(1)) number = number * 10 + (digit - '0');
    if (setting(number) != &node) {
      context_.unmapped(&node, node.name, "this setting is given twice: the last one counts");
    }
  }
  context_.list_rest(tree_, "", "");
  for (UnmappedValue& value : context_.result().unmapped) {
    if (!value.reason.empty() || !value.source.starts_with('$') || value.source.size() > 5) continue;
    int number = 0;
    for (const char digit : value.source.substr(1)) number = number * 10 + (digit - '0');
    value.reason = reason_of_setting(number);
  }
}

void SettingsImport::import() {
  find_firmware();
  if (context_.has_failed()) return;
  find_letters();
  homing_ = mask(22).value_or(0);
  for (std::size_t i = 0; i < letters_.size(); ++i) {
    if (setting(100 + static_cast<int>(i)) != nullptr) read_axis(letters_[i], static_cast<int>(i));
  }
  if (model_.core_xy && !context_.has_failed()) check_core_xy();
  read_levels();
  read_spindle();
  read_soft_limits();
  if (firmware_ == GrblFirmware::fluidnc) {
    context_.warn(
        "FluidNC keeps pins, switches and the position of home in its YAML configuration: import that instead");
  }
  list_rest();
}

}  // namespace

void import_settings(const SourceNode& tree, ImportContext& context, ImportedModel& model) {
  SettingsImport(tree, context, model).import();
}

}  // namespace passo
