// A profile of Mach3: <profile><Preferences>, a flat list of some thousand elements.
//
// There is no public description of the format. Used here is what Mach3's own screens name, and what LinuxCNC's import
// of such profiles uses: Steps0 to Steps5 (steps per unit), Vel0 (units per second), Acc0 (units per second²), M0Max and
// M0Min (soft limits), Motor0Active, Motor0DirNeg, Units (0: millimetres). What the screens show per minute is stored
// per second.
#include <algorithm>
#include <array>

#include "format_imports.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::array mach3_axes = {Axis::x, Axis::y, Axis::z, Axis::a, Axis::b, Axis::c};

class Mach3Import {
 public:
  Mach3Import(const SourceNode& tree, ImportContext& context, ImportedModel& model)
      : preferences_(tree.name == "Preferences" ? tree : preferences_of(tree)), context_(context), model_(model) {}

  void import();

 private:
  static const SourceNode& preferences_of(const SourceNode& tree) {
    const SourceNode* found = tree.child("Preferences");
    return found == nullptr ? tree : *found;
  }
  const SourceNode* value(const std::string& key) const { return preferences_.child(key); }
  bool is_on(const std::string& key);
  void read_units();
  void read_axis(std::size_t index);
  void read_direction(ImportedAxis& axis, std::size_t index);
  void read_slave();
  void read_backlash(ImportedAxis& axis, std::size_t index, UnitFactor unit);
  void list_homing(std::size_t index);
  void list_rest();

  const SourceNode& preferences_;
  ImportContext& context_;
  ImportedModel& model_;
  UnitFactor length_;
};

bool Mach3Import::is_on(const std::string& key) {
  const SourceNode* node = value(key);
  if (node == nullptr) return false;
  context_.mark(*node);
  return context_.mask(node, key).value_or(0) != 0;
}

void Mach3Import::read_units() {
  const SourceNode* units = value("Units");
  if (units == nullptr) {
    context_.error("import.units", ValueOrigin{}, "the profile does not say the unit of length",
                   "<Units>0</Units> for millimetres, or 1 for inches");
    return;
  }
  const auto inches = context_.mask(units, "Units");
  if (!inches || *inches > 1) {
    context_.error("import.units", context_.origin(*units, "Units"), "the unit of length is unknown",
                   "<Units>0</Units> for millimetres, or 1 for inches");
    return;
  }
  context_.understood(context_.origin(*units, "Units"),
                      *inches == 1 ? "all lengths are converted from inches" : "all lengths are in millimetres");
  if (*inches == 0) return;
  length_ = {254, 10};
  context_.warn("the source is in inches: all lengths are converted to millimetres");
}

void Mach3Import::read_direction(ImportedAxis& axis, std::size_t index) {
  const std::string pin = fmt::format("Motor{}DirNeg", index);
  const std::string reversed = fmt::format("M{}Rev", index);
  const bool is_reversed = is_on(reversed);
  const bool is_low = is_on(pin);
  const SourceNode* shown = is_reversed || value(pin) == nullptr ? value(reversed) : value(pin);
  if (shown == nullptr) return;
  axis.inverted = SourcedFlag{is_reversed != is_low, context_.origin(*shown, shown->name)};
  if (is_reversed && value(pin) != nullptr) {
    context_.understood(context_.origin(*value(pin), pin), fmt::format("axis.{}.inverted", letter_of(axis.axis)));
  }
}

void Mach3Import::read_backlash(ImportedAxis& axis, std::size_t index, UnitFactor unit) {
  const std::string key = fmt::format("Back{}", letter_of(mach3_axes[index]));
  const bool is_compensated = is_on("BacklashOn");
  auto backlash = context_.optional_number(value(key), key, unit);
  if (!backlash || backlash->value.value() == 0) return;
  if (is_compensated) {
    axis.backlash = backlash;
  } else {
    context_.unmapped(backlash->origin, "the compensation of backlash is off (BacklashOn)");
  }
}

void Mach3Import::read_axis(std::size_t index) {
  const Axis letter = mach3_axes[index];
  ImportedAxis axis{.axis = letter};
  const std::string number = fmt::format("{}", index);
  if (is_rotary(letter) && value(fmt::format("{}Angular", letter_of(letter))) != nullptr &&
      !is_on(fmt::format("{}Angular", letter_of(letter)))) {
    context_.warn(fmt::format("axis {} is a linear axis in Mach3 ({}Angular), but a machine file has it in degrees",
                              letter_of(letter), letter_of(letter)));
  }
  const UnitFactor unit = is_rotary(letter) ? UnitFactor{} : length_;
  axis.scale = context_.number(value("Steps" + number), "Steps" + number, {unit.divisor, unit.factor});
  axis.velocity = context_.number(value("Vel" + number), "Vel" + number, unit);
  axis.acceleration = context_.number(value("Acc" + number), "Acc" + number, unit);
  axis.low = context_.number(value(fmt::format("M{}Min", index)), fmt::format("M{}Min", index), unit);
  axis.high = context_.number(value(fmt::format("M{}Max", index)), fmt::format("M{}Max", index), unit);
  if (axis.low && axis.high && !(axis.low->value < axis.high->value)) {
    context_.unmapped(axis.low->origin, "the lower soft limit is not below the upper one");
    context_.unmapped(axis.high->origin, "the lower soft limit is not below the upper one");
    axis.low.reset();
    axis.high.reset();
  }
  read_direction(axis, index);
  read_backlash(axis, index, unit);
  list_homing(index);
  model_.axes.push_back(std::move(axis));
}

// Mach3 homes at one speed, and rests where the switch opens: [axis.X.home] needs more.
void Mach3Import::list_homing(std::size_t index) {
  const std::string input = fmt::format("Input{}Active", 3 * index + 2);
  const bool has_switch = is_on(input);
  const std::string reason =
      fmt::format("write [axis.{}.home]: it needs a switch position, two speeds and a pull-off, which Mach3 does not have",
                  letter_of(mach3_axes[index]));
  for (const std::string& key : {fmt::format("M{}Neg", index), fmt::format("RefSpeed{}", index),
                                 fmt::format("M{}AutoZero", index), input}) {
    context_.unmapped(value(key), key, has_switch ? reason : "no home switch in Mach3");
  }
}

// An axis that follows another one: both have a motor, and the machine file has one axis with two.
void Mach3Import::read_slave() {
  const SourceNode* slave = value("Slave");
  const SourceNode* first = value("SlavePrim");
  if (slave == nullptr || first == nullptr) return;
  context_.mark(*first);
  context_.mark(*slave);
  const auto slave_number = DecimalNumber::parse(slave->text);
  const auto first_number = DecimalNumber::parse(first->text);
  if (!slave_number || !first_number || slave_number->value() < 0) return;
  const auto axis_with = [&](const DecimalNumber& number) {
    return std::ranges::find_if(model_.axes, [&](const ImportedAxis& axis) {
      return static_cast<double>(index_of(axis.axis)) == number.value();
    });
  };
  const auto follower = axis_with(*slave_number);
  const auto leader = axis_with(*first_number);
  const ValueOrigin origin = context_.origin(*slave, "Slave");
  if (follower == model_.axes.end() || leader == model_.axes.end() || follower == leader) {
    context_.unmapped(origin, "which axes are slaved is not clear");
    return;
  }
  leader->second = ImportedSecondMotor{.origin = origin};
  if (follower->inverted) leader->second->inverted = follower->inverted;
  const char letter = letter_of(leader->axis);
  context_.warn(fmt::format("axis {} follows axis {}: check [axis.{}.second_motor]", letter_of(follower->axis), letter, letter));
  model_.axes.erase(follower);
}

void Mach3Import::list_rest() {
  // Thousands of elements of screens, keys and displays: only their number is of use.
  constexpr std::string_view of_motion[] = {"Motor", "Vel", "Acc", "Steps", "M0", "M1", "M2", "M3", "M4", "M5", "Slave", "AxisToMotor"};
  std::size_t others = 0;
  for (const SourceNode& node : preferences_.children) {
    const bool is_of_motion = std::ranges::any_of(of_motion, [&](std::string_view prefix) { return node.name.starts_with(prefix); });
    const bool is_of_active_axis = std::ranges::any_of(model_.axes, [&](const ImportedAxis& axis) {
      return node.name.find(static_cast<char>('0' + index_of(axis.axis))) != std::string::npos;
    });
    if (is_of_motion && is_of_active_axis) continue;
    context_.mark_all(node);
    ++others;
  }
  context_.list_rest(preferences_, "", "/", "no equivalent, or not understood");
  context_.unmapped({.key = "other elements", .value = fmt::format("{}", others)},
                    "screens, keys, displays, pins, tools and axes that are off");
}

void Mach3Import::import() {
  context_.result().controller = "Mach3";
  const SourceNode* profile = value("Profile");
  if (profile != nullptr && !profile->text.empty()) {
    context_.mark(*profile);
    model_.name = {ImportContext::printable(profile->text), context_.origin(*profile, "Profile")};
  } else {
    model_.name = {"Mach3 machine", {.key = {}, .value = {}, .reason = "the profile has no name"}};
  }
  read_units();
  if (context_.has_failed()) return;
  for (std::size_t i = 0; i < mach3_axes.size(); ++i) {
    if (is_on(fmt::format("Motor{}Active", i))) read_axis(i);
  }
  read_slave();
  model_.step_pulse_us = context_.optional_number(value("PulseWidth"), "PulseWidth");
  model_.direction_setup_us = context_.optional_number(value("DirPulse"), "DirPulse");
  if (const SourceNode* soft = value("SoftLimit"); soft != nullptr) {
    const bool on = is_on("SoftLimit");
    context_.understood(context_.origin(*soft, "SoftLimit"), "the travel, which Passo always enforces");
    if (!on) context_.warn("the soft limits are off in Mach3, so the travel may be wrong; Passo enforces it");
  }
  context_.warn("the levels of pins are not taken over: check the directions, the switches and the outputs");
  list_rest();
}

}  // namespace

void import_mach3(const SourceNode& tree, ImportContext& context, ImportedModel& model) {
  Mach3Import(tree, context, model).import();
}

}  // namespace passo
