// FluidNC's configuration (YAML). Keys: github.com/bdring/FluidNC, FluidNC/src/Machine and wiki.fluidnc.com.
//
// A pin is active high unless its text has ":low". The position mpos_mm is that of the axis after homing, at the end of
// its travel.
#include <algorithm>
#include <array>

#include "format_imports.hpp"
#include <fmt/format.h>

#include "passo/base/lower_case.hpp"

namespace passo {
namespace {

// FluidNC compares its keys without regard to case.
const SourceNode* fluid_child(const SourceNode* node, std::string_view wanted) {
  if (node == nullptr) return nullptr;
  const auto found =
      std::ranges::find_if(node->children, [&](const SourceNode& child) { return lower_case(child.name) == wanted; });
  return found == node->children.end() ? nullptr : &*found;
}

bool is_pin(const SourceNode* node) {
  if (node == nullptr) return false;
  const std::string pin = lower_case(node->text);
  return !pin.empty() && pin != "no_pin" && pin != "void" && pin != "null" && pin != "~";
}

bool is_active_low(const SourceNode& pin) {
  return lower_case(pin.text).find(":low") != std::string::npos;
}

// Sections without anything for a machine file.
constexpr std::array other_sections = {"spi",
                                       "sdcard",
                                       "macros",
                                       "user_outputs",
                                       "user_inputs",
                                       "i2so",
                                       "i2c0",
                                       "i2c1",
                                       "uart0",
                                       "uart1",
                                       "uart2",
                                       "uart_channel0",
                                       "uart_channel1",
                                       "uart_channel2",
                                       "start",
                                       "parking",
                                       "oled",
                                       "status_outputs",
                                       "extenders",
                                       "atc_manual",
                                       "atc_basic",
                                       "planner_blocks",
                                       "verbose_errors",
                                       "report_inches",
                                       "enable_parking_override_control",
                                       "use_line_numbers",
                                       "board",
                                       "meta"};

constexpr std::array spindles = {
    "pwm",         "10v",       "laser",         "relay",    "onoff",      "hbridge",    "besc",      "dac",
    "huanyang",    "h2a",       "h100",          "yl620",    "nowforever", "siemensv20", "modbusvfd", "danfossvlt2800",
    "folinnbd600", "mollomg70", "plasmaspindle", "nospindle"};

class FluidNcImport {
 public:
  FluidNcImport(const SourceNode& tree, ImportContext& context, ImportedModel& model)
      : tree_(tree), context_(context), model_(model) {}

  void import();

 private:
  void check_kinematics();
  void read_stepping();
  void read_axis(const SourceNode& node, Axis letter);
  void read_travel(ImportedAxis& axis, const SourceNode& node, const SourceNode* homing, const std::string& path);
  void read_home(ImportedAxis& axis, const SourceNode& node, const SourceNode& homing, const std::string& path);
  void read_motor(ImportedAxis& axis, const SourceNode& motor, const std::string& path, bool is_second);
  void read_motor_pins(ImportedAxis& axis, const SourceNode& driver, const std::string& path, bool is_second);
  void note_level(ImportedPin pin, const SourceNode& node, const std::string& path, bool high);
  void read_pin(ImportedPin pin, const SourceNode* section, std::string_view key, const std::string& path);
  void read_spindle(const SourceNode& node);
  void read_speed_map(const SourceNode* map, const std::string& path);
  void mark_unused_pins(const SourceNode& node);
  void list_sections();

  const SourceNode& tree_;
  ImportContext& context_;
  ImportedModel& model_;
  bool has_spindle_ = false;
};

void FluidNcImport::check_kinematics() {
  const SourceNode* kinematics = fluid_child(&tree_, "kinematics");
  if (kinematics == nullptr) return;
  context_.mark_all(*kinematics);
  for (const SourceNode& kind : kinematics->children) {
    if (lower_case(kind.name) == "cartesian") continue;
    ValueOrigin origin = context_.origin(kind, "kinematics");
    origin.value = ImportContext::printable(kind.name);
    context_.error("import.kinematics", origin, fmt::format("the machine has the kinematics {}", origin.value),
                   "Cartesian: a machine file describes machines with a motor, or two, for each axis");
  }
}

void FluidNcImport::read_stepping() {
  const SourceNode* stepping = fluid_child(&tree_, "stepping");
  if (stepping == nullptr) return;
  model_.step_pulse_us = context_.optional_number(fluid_child(stepping, "pulse_us"), "stepping/pulse_us");
  model_.direction_setup_us = context_.optional_number(fluid_child(stepping, "dir_delay_us"), "stepping/dir_delay_us");
  context_.unmapped(fluid_child(stepping, "idle_ms"), "stepping/idle_ms",
                    "the drivers stay enabled while a program is connected; see drivers_off_after_s in [outputs]");
  for (const char* key : {"engine", "segments", "disable_delay_us"}) {
    context_.unmapped(fluid_child(stepping, key), fmt::format("stepping/{}", key), "no equivalent");
  }
}

void FluidNcImport::note_level(ImportedPin pin, const SourceNode& node, const std::string& path, bool high) {
  context_.mark(node);
  auto& level = model_.pin(pin);
  const ValueOrigin origin = context_.origin(node, path);
  if (level && level->value != high) {
    context_.unmapped(origin, "another pin has the other level, and a machine file has one for all");
    return;
  }
  level = SourcedFlag{high, origin};
}

void FluidNcImport::read_pin(ImportedPin pin, const SourceNode* section, std::string_view key,
                             const std::string& path) {
  const SourceNode* node = fluid_child(section, key);
  if (is_pin(node)) note_level(pin, *node, path, !is_active_low(*node));
}

void FluidNcImport::read_axis(const SourceNode& node, Axis letter) {
  const std::string path = "axes/" + node.name;
  ImportedAxis axis{.axis = letter};
  const auto assumed = [](std::int64_t value) {
    return SourcedNumber{DecimalNumber(value), {.key = {}, .value = {}, .reason = "FluidNC's default"}};
  };
  const auto number = [&](const char* key, UnitFactor unit, std::int64_t usual) {
    const SourceNode* child = fluid_child(&node, key);
    if (child == nullptr)
      return std::optional(
          SourcedNumber{assumed(usual).value.scaled(unit.factor, unit.divisor), assumed(usual).origin});
    return context_.number(child, fmt::format("{}/{}", path, key), unit);
  };
  axis.scale = number("steps_per_mm", {}, 80);
  axis.velocity = number("max_rate_mm_per_min", {1, 60}, 1000);
  axis.acceleration = number("acceleration_mm_per_sec2", {}, 25);
  const SourceNode* homing = fluid_child(&node, "homing");
  read_travel(axis, node, homing, path);
  if (const SourceNode* motor = fluid_child(&node, "motor0")) read_motor(axis, *motor, path + "/motor0", false);
  const SourceNode* second = fluid_child(&node, "motor1");
  if (second != nullptr && !second->children.empty() && fluid_child(second, "null_motor") == nullptr) {
    axis.second = ImportedSecondMotor{.origin = context_.origin(*second, path + "/motor1")};
    axis.second->inverted = SourcedFlag{false, axis.second->origin};
    read_motor(axis, *second, path + "/motor1", true);
    if (homing != nullptr && !axis.second->limit_high) {
      context_.warn(
          fmt::format("the second motor of axis {} has no limit switch of its own: Passo squares an axis with two "
                      "switches",
                      letter_of(letter)));
    }
  }
  if (homing != nullptr) read_home(axis, node, *homing, path);
  model_.axes.push_back(std::move(axis));
}

void FluidNcImport::read_travel(ImportedAxis& axis, const SourceNode& node, const SourceNode* homing,
                                const std::string& path) {
  auto length = context_.number(fluid_child(&node, "max_travel_mm"), path + "/max_travel_mm");
  if (!length && fluid_child(&node, "max_travel_mm") == nullptr) {
    length = SourcedNumber{DecimalNumber(1000), {.key = {}, .value = {}, .reason = "FluidNC's default"}};
  }
  const auto end = context_.number(fluid_child(homing, "mpos_mm"), path + "/homing/mpos_mm");
  if (!length) return;
  length->value = length->value.magnitude();
  const SourceNode* direction = fluid_child(homing, "positive_direction");
  const bool homes_high = homing == nullptr || direction == nullptr || lower_case(direction->text) != "false";
  const SourcedNumber zero{DecimalNumber(0), length->origin};
  const SourcedNumber home = end ? *end : zero;
  const SourcedNumber far{homes_high ? home.value - length->value : home.value + length->value, length->origin};
  axis.low = homes_high ? far : home;
  axis.high = homes_high ? home : far;
  const SourceNode* soft = fluid_child(&node, "soft_limits");
  if (soft == nullptr) return;
  context_.mark(*soft);
  context_.understood(context_.origin(*soft, path + "/soft_limits"), "the travel, which Passo always enforces");
  if (lower_case(soft->text) == "true") return;
  context_.warn(
      fmt::format("the soft limits of axis {} are off in FluidNC, so its travel may be wrong; Passo enforces it",
                  letter_of(axis.axis)));
}

void FluidNcImport::read_home(ImportedAxis& axis, const SourceNode& node, const SourceNode& homing,
                              const std::string& path) {
  const auto own = [&](const char* key) { return fmt::format("{}/homing/{}", path, key); };
  for (const char* key : {"settle_ms", "seek_scaler", "feed_scaler", "allow_single_axis"}) {
    context_.unmapped(fluid_child(&homing, key), own(key), "no equivalent");
  }
  const auto cycle = context_.optional_number(fluid_child(&homing, "cycle"), own("cycle"));
  const auto seek = context_.optional_number(fluid_child(&homing, "seek_mm_per_min"), own("seek_mm_per_min"), {1, 60});
  const auto latch = context_.optional_number(fluid_child(&homing, "feed_mm_per_min"), own("feed_mm_per_min"), {1, 60});
  const SourceNode* direction = fluid_child(&homing, "positive_direction");
  if (direction != nullptr) context_.mark(*direction);
  const auto pull_off =
      context_.optional_number(fluid_child(fluid_child(&node, "motor0"), "pulloff_mm"), path + "/motor0/pulloff_mm");
  if (!cycle || cycle->value.value() < 1 || !axis.low || !axis.high) return;
  if (!axis.limit_high) {
    context_.warn(fmt::format("axis {} is not homed by the machine file: its first motor has no limit pin",
                              letter_of(axis.axis)));
    return;
  }
  if (!seek || !latch || !pull_off) {
    context_.warn(
        fmt::format("axis {} is not homed by the machine file: it needs seek_mm_per_min, feed_mm_per_min and "
                    "pulloff_mm",
                    letter_of(axis.axis)));
    return;
  }
  const bool high = direction == nullptr || lower_case(direction->text) != "false";
  const ValueOrigin from = direction == nullptr ? ValueOrigin{.key = {}, .value = {}, .reason = "FluidNC's default"}
                                                : context_.origin(*direction, own("positive_direction"));
  const SourcedNumber& rest = high ? *axis.high : *axis.low;
  const DecimalNumber off = pull_off->value;
  axis.home = ImportedHome{.is_high = {high, from},
                           .switch_at = {high ? rest.value + off : rest.value - off, rest.origin},
                           .seek = *seek,
                           .latch = *latch,
                           .pull_off = pull_off,
                           .turn = static_cast<int>(std::min(cycle->value.value(), 100.0)),
                           .turn_origin = cycle->origin};
}

void FluidNcImport::read_motor(ImportedAxis& axis, const SourceNode& motor, const std::string& path, bool is_second) {
  const SourceNode* homing_pins[] = {fluid_child(&motor, "limit_all_pin"), fluid_child(&motor, "limit_neg_pin"),
                                     fluid_child(&motor, "limit_pos_pin")};
  for (const SourceNode* pin : homing_pins) {
    if (!is_pin(pin)) continue;
    auto& level = is_second ? axis.second->limit_high : axis.limit_high;
    const std::string name = fmt::format("{}/{}", path, pin->name);
    if (level) {
      context_.unmapped(pin, name, "a machine file has one limit switch for each motor");
    } else {
      context_.mark(*pin);
      level = SourcedFlag{!is_active_low(*pin), context_.origin(*pin, name)};
    }
  }
  context_.unmapped(fluid_child(&motor, "hard_limits"), path + "/hard_limits",
                    "no equivalent: a machine file has no key for hard limits");
  if (is_second) {
    context_.unmapped(fluid_child(&motor, "pulloff_mm"), path + "/pulloff_mm",
                      "one distance for both motors; the difference is square_mm in [axis.X.second_motor]");
  }
  for (const SourceNode& driver : motor.children) {
    if (!driver.children.empty()) read_motor_pins(axis, driver, fmt::format("{}/{}", path, driver.name), is_second);
  }
}

void FluidNcImport::read_motor_pins(ImportedAxis& axis, const SourceNode& driver, const std::string& path,
                                    bool is_second) {
  if (const SourceNode* direction = fluid_child(&driver, "direction_pin"); is_pin(direction)) {
    context_.mark(*direction);
    const SourcedFlag reversed{is_active_low(*direction), context_.origin(*direction, path + "/direction_pin")};
    (is_second ? axis.second->inverted : axis.inverted) = reversed;
  }
  read_pin(ImportedPin::step, &driver, "step_pin", path + "/step_pin");
  // The pin that disables a driver: high by default, so the level that enables it is low.
  if (const SourceNode* disable = fluid_child(&driver, "disable_pin"); is_pin(disable)) {
    note_level(ImportedPin::driver_enable, *disable, path + "/disable_pin", is_active_low(*disable));
  }
  for (const char* key : {"step_pin", "direction_pin", "disable_pin"}) {
    if (const SourceNode* pin = fluid_child(&driver, key)) context_.mark(*pin);
  }
  const std::string kind = lower_case(driver.name);
  if (kind.find("servo") != std::string::npos || kind.find("solenoid") != std::string::npos ||
      kind.find("dynamixel") != std::string::npos) {
    context_.warn(fmt::format("axis {} is turned by a {}, not by a stepper motor", letter_of(axis.axis),
                              ImportContext::printable(driver.name)));
  }
  context_.list_rest(driver, path, "/", "no equivalent: the driver and its pins");
}

void FluidNcImport::read_speed_map(const SourceNode* map, const std::string& path) {
  if (map == nullptr) return;
  context_.mark(*map);
  std::optional<DecimalNumber> highest;
  std::string_view rest = map->text;
  while (!rest.empty()) {
    const std::string_view entry = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
    const auto speed = DecimalNumber::parse(entry.substr(0, entry.find('=')));
    if (speed && (!highest || *highest < *speed)) highest = speed;
  }
  const ValueOrigin origin = context_.origin(*map, path);
  if (highest) {
    model_.max_rpm = SourcedNumber{*highest, origin};
  } else {
    context_.unmapped(origin, "this is not a speed map such as 0=0% 1000=100%");
  }
}

void FluidNcImport::read_spindle(const SourceNode& node) {
  const std::string& path = node.name;
  if (has_spindle_) {
    context_.mark_all(node);
    context_.unmapped(context_.origin(node, path), "a machine file has one spindle");
    return;
  }
  has_spindle_ = true;
  const std::string kind = lower_case(node.name);
  if (kind == "laser") context_.warn("the controller drives a laser: Passo treats it as a spindle");
  const SourceNode* speeds = fluid_child(&node, "speed_map");
  if (kind == "relay" || kind == "onoff") {
    context_.unmapped(speeds, path + "/speed_map", "a relay has no speeds");
  } else {
    read_speed_map(speeds, path + "/speed_map");
  }
  read_pin(ImportedPin::spindle, &node, "output_pin", path + "/output_pin");
  read_pin(ImportedPin::spindle_reverse, &node, "direction_pin", path + "/direction_pin");
  const SourceNode* spin_up = fluid_child(&node, "spinup_ms");
  if (spin_up != nullptr && model_.max_rpm && model_.max_rpm->value.value() > 0) {
    // The time to the highest speed; the machine file has the time to 1000 rpm.
    if (const auto time = context_.optional_number(spin_up, path + "/spinup_ms")) {
      const double seconds = time->value.value() / model_.max_rpm->value.value();
      model_.run_up_s = SourcedNumber{DecimalNumber::of(seconds), time->origin};
    }
  }
  context_.list_rest(node, path, "/", "no equivalent");
}

// NO_PIN says nothing, nor does a key without a value.
void FluidNcImport::mark_unused_pins(const SourceNode& node) {
  for (const SourceNode& child : node.children) {
    if (child.children.empty() && !is_pin(&child)) context_.mark(child);
    mark_unused_pins(child);
  }
}

void FluidNcImport::list_sections() {
  for (const char* key : {"junction_deviation_mm", "arc_tolerance_mm"}) {
    context_.unmapped(fluid_child(&tree_, key), key, "no equivalent: Passo rounds corners within path_tolerance_mm");
  }
  for (const SourceNode& section : tree_.children) {
    const std::string name = lower_case(section.name);
    const bool is_known = std::ranges::find(other_sections, name) != other_sections.end();
    if (!is_known) continue;
    if (section.children.empty()) {
      context_.unmapped(&section, section.name, "no equivalent in a machine file");
      continue;
    }
    context_.mark_all(section);
    ValueOrigin origin = context_.origin(section, section.name);
    origin.value = fmt::format("{} keys", section.children.size());
    context_.unmapped(origin, "no equivalent in a machine file");
  }
  context_.list_rest(tree_, "", "/");
}

void FluidNcImport::import() {
  context_.result().controller = "FluidNC";
  mark_unused_pins(tree_);
  check_kinematics();
  const SourceNode* name = fluid_child(&tree_, "name");
  if (name != nullptr && !name->text.empty()) {
    context_.mark(*name);
    model_.name = {ImportContext::printable(name->text), context_.origin(*name, "name")};
  } else {
    model_.name = {"FluidNC machine", {.key = {}, .value = {}, .reason = "the configuration has no name"}};
  }
  read_stepping();
  if (const SourceNode* axes = fluid_child(&tree_, "axes")) {
    for (const SourceNode& node : axes->children) {
      const auto letter = node.name.size() == 1 ? axis_of(node.name[0]) : std::nullopt;
      const bool is_new = letter && std::ranges::find(model_.axes, *letter, &ImportedAxis::axis) == model_.axes.end();
      if (is_new && !node.children.empty()) read_axis(node, *letter);
    }
    if (const SourceNode* disable = fluid_child(axes, "shared_stepper_disable_pin"); is_pin(disable)) {
      note_level(ImportedPin::driver_enable, *disable, "axes/shared_stepper_disable_pin", is_active_low(*disable));
    }
  }
  read_pin(ImportedPin::probe, fluid_child(&tree_, "probe"), "pin", "probe/pin");
  const SourceNode* control = fluid_child(&tree_, "control");
  read_pin(ImportedPin::door, control, "safety_door_pin", "control/safety_door_pin");
  read_pin(ImportedPin::feed_hold, control, "feed_hold_pin", "control/feed_hold_pin");
  read_pin(ImportedPin::cycle_start, control, "cycle_start_pin", "control/cycle_start_pin");
  read_pin(ImportedPin::emergency_stop, control, "estop_pin", "control/estop_pin");
  const SourceNode* coolant = fluid_child(&tree_, "coolant");
  read_pin(ImportedPin::flood, coolant, "flood_pin", "coolant/flood_pin");
  read_pin(ImportedPin::mist, coolant, "mist_pin", "coolant/mist_pin");
  for (const SourceNode& section : tree_.children) {
    const bool is_spindle = std::ranges::find(spindles, lower_case(section.name)) != spindles.end();
    if (is_spindle && !section.children.empty()) read_spindle(section);
  }
  list_sections();
}

}  // namespace

void import_fluidnc(const SourceNode& tree, ImportContext& context, ImportedModel& model) {
  FluidNcImport(tree, context, model).import();
}

}  // namespace passo
