// docs/manual/machine-file.md describes the same keys to the user. tests/machine_manual_test.cpp compares the two.
#include "machine_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "axis_keys.hpp"
#include "board_reader.hpp"
#include "camera_reader.hpp"
#include "core_xy_check.hpp"
#include "encoder_reader.hpp"
#include "handwheel_reader.hpp"
#include "homing_reader.hpp"
#include "hooks_reader.hpp"
#include "machine_file_sentences.hpp"
#include "motion_outputs_reader.hpp"
#include "park_reader.hpp"
#include "pins_reader.hpp"
#include "screw_reader.hpp"
#include "spindle_reader.hpp"
#include "surface_radius_reader.hpp"
#include "tool_change_reader.hpp"
#include "torque_reader.hpp"
#include <fmt/format.h>

#include "passo/toml/table_reader.hpp"

namespace passo {
namespace {

constexpr NumberKey path_tolerance_key{"path_tolerance_mm", 1e-4, 10, "0.02"};
constexpr NumberKey path_tolerance_deg_key{"path_tolerance_deg", 1e-4, 10, "0.05"};

constexpr std::string_view kinematics_key = "kinematics";
const char* const kinematics_code = "machine.kinematics";

constexpr NumberKey rpm_key{"max_rpm", 0, 65535, "10000"};
constexpr NumberKey tool_diameter_key{"diameter_mm", 0, 1000, "3"};

constexpr NumberKey turn_key{"steps_per_turn", 1, 1e6, "400"};
constexpr NumberKey microsteps_key{"microsteps", 1, 1024, "16"};
constexpr NumberKey motor_key{"motor", 0, most_motors - 1, "0"};
constexpr std::string_view torque_table = "torque";
constexpr std::string_view home_table = "home";
constexpr std::string_view second_table = "second_motor";

class MachineReader {
 public:
  MachineReader(const TomlDocument& document, const TomlReporter& reporter, MachineUse use)
      : document_(document), reporter_(reporter), use_(use) {}

  MachineDescription read();

 private:
  struct AxisEntry {
    AxisDescription description;
    std::optional<std::size_t> motor;
    SourceLocation place;           // of the axis's table
    SourceLocation motor_position;  // of the motor number in it
  };

  void read_kinematics(TableReader& top);
  void check_kinematics(const SourceLocation& key) const;
  void read_board(const TomlEntry& entry);
  void read_tool(const TomlEntry& entry);
  void read_probe(const TomlEntry& entry);
  void read_spindle(const TomlEntry& entry);
  void read_silence(const TomlEntry& entry);
  void look_at_work(const TomlEntry& entry) const;
  void read_pins(const TomlEntry* inputs, const TomlEntry* outputs);
  void read_park_of(const TomlEntry& entry);
  void read_homing(const TomlEntry* entry);
  void read_axes(const TomlEntry& entry);
  void read_axis(const TomlEntry& entry, Axis axis);
  void read_motion(TableReader& reader, const AxisKeys& keys, AxisDescription& axis);
  std::optional<HomeDescription> read_home_of(TableReader& reader, const AxisDescription& axis);
  void read_second_of(TableReader& reader, AxisDescription& axis);
  static void read_start_stop(TableReader& reader, const AxisKeys& keys, AxisDescription& axis);
  void read_acceleration(TableReader& reader, const AxisKeys& keys, AxisDescription& axis) const;
  static std::optional<double> way_of_a_turn(const TableReader& reader, const AxisKeys& keys, Axis axis);
  double read_scale(TableReader& reader, const AxisKeys& keys, Axis axis) const;
  void check_velocity(const TableReader& reader, const AxisKeys& keys, const AxisDescription& axis) const;
  void order_motors();
  void number_motors();
  void number_second_motors();

  void finish(TableReader& reader) const {
    reader.finish(document_.complete, {"name", kinematics_key, path_tolerance_key.name, path_tolerance_deg_key.name});
  }

  const TomlDocument& document_;
  const TomlReporter& reporter_;
  MachineUse use_;
  MachineDescription machine_;
  std::optional<Hertz> event_rate_;  // the board's, if it is right
  std::vector<AxisEntry> axes_;
  bool motors_are_readable_ = true;
  bool homes_are_readable_ = true;
};

MachineDescription MachineReader::read() {
  TableReader top(document_.root, "", {}, reporter_);
  if (const auto name = top.text("name", "My machine", Need::required)) machine_.name = *name;
  if (const auto tolerance = top.number(path_tolerance_key, Need::optional)) machine_.path_tolerance = Mm(*tolerance);
  machine_.path_tolerance_deg =
      top.number(path_tolerance_deg_key, Need::optional).value_or(machine_.path_tolerance_deg);
  read_kinematics(top);
  const TomlEntry* board = top.table("board", "a table [board] with the board's clock", Need::required);
  const TomlEntry* tool = top.table("tool", "a table [tool]", Need::optional);
  const TomlEntry* probe = top.table("probe", "a table [probe]", Need::optional);
  const TomlEntry* spindle = top.table("spindle", "a table [spindle]", Need::optional);
  const TomlEntry* silence = top.table("silence", "a table [silence]", Need::optional);
  const TomlEntry* work = top.table("work", "a table [work]", Need::optional);
  const TomlEntry* park = top.table("park", "a table [park]", Need::optional);
  const TomlEntry* inputs = top.table("inputs", "a table [inputs]", Need::optional);
  const TomlEntry* outputs = top.table("outputs", "a table [outputs]", Need::optional);
  const TomlEntry* homing = top.table("homing", "a table [homing]", Need::optional);
  const TomlEntry* tool_change = top.table("tool_change", "a table [tool_change]", Need::optional);
  const TomlEntry* hooks = top.table("hooks", "a table [hooks]", Need::optional);
  const TomlEntry* camera = top.table("camera", "a table [camera]", Need::optional);
  const TomlEntry* handwheel = top.table("handwheel", "a table [handwheel]", Need::optional);
  const TomlEntry* axes = top.table("axis", machine_file_says::axis_table.text, Need::required);
  const auto end = [this](TableReader& inner) { finish(inner); };
  machine_.motion_outputs = read_motion_outputs(top, reporter_, end);
  finish(top);
  if (board != nullptr) read_board(*board);
  if (tool != nullptr) read_tool(*tool);
  if (probe != nullptr) read_probe(*probe);
  if (spindle != nullptr) read_spindle(*spindle);
  if (silence != nullptr) read_silence(*silence);
  if (work != nullptr) look_at_work(*work);
  read_pins(inputs, outputs);
  if (axes != nullptr) read_axes(*axes);
  if (machine_.is_core_xy && axes != nullptr) check_kinematics(top.place_of(kinematics_key));
  if (park != nullptr) read_park_of(*park);
  read_homing(homing);
  if (hooks != nullptr) machine_.hooks = read_hooks(*hooks, reporter_, end);
  if (camera != nullptr) check_camera(*camera, reporter_, end);
  if (handwheel != nullptr) machine_.handwheel = read_handwheel(*handwheel, machine_.axes, reporter_, end);
  if (tool_change != nullptr) machine_.tool_change = read_tool_change(*tool_change, machine_.axes, reporter_, end);
  return std::move(machine_);
}

void MachineReader::read_kinematics(TableReader& top) {
  const auto kind = top.text(kinematics_key, "corexy", Need::optional);
  if (!kind || *kind == "cartesian") return;
  machine_.is_core_xy = *kind == "corexy";
  if (machine_.is_core_xy) return;
  top.error(kinematics_code, kinematics_key, fmt::format("{} = \"{}\"", kinematics_key, kind->substr(0, 40)),
            "\"corexy\"; without this key, or with \"cartesian\", each axis has a motor, or two");
}

// Called when all axes are known.
void MachineReader::check_kinematics(const SourceLocation& key) const {
  std::vector<PlacedAxis> axes;
  for (const AxisEntry& entry : axes_) axes.push_back({entry.description, entry.place});
  check_core_xy(reporter_, key, use_, axes, document_.complete);
}

void MachineReader::read_board(const TomlEntry& entry) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "board", entry.place, reporter_);
  event_rate_ = passo::read_board(reader, machine_.board);
  finish(reader);
}

void MachineReader::read_tool(const TomlEntry& entry) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "tool", entry.place, reporter_);
  ToolDescription& tool = machine_.tool;
  if (const auto name = reader.text("name", "Spindle", Need::optional)) tool.name = *name;
  if (const auto rpm = reader.number(rpm_key, Need::optional)) tool.highest_rpm = *rpm;
  if (const auto diameter = reader.number(tool_diameter_key, Need::optional)) tool.diameter = Mm(*diameter);
  finish(reader);
}

void MachineReader::read_probe(const TomlEntry& entry) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "probe", entry.place, reporter_);
  machine_.probe.guards = reader.flag("guards").value_or(false);
  finish(reader);
}

void MachineReader::read_spindle(const TomlEntry& entry) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "spindle", entry.place, reporter_);
  machine_.spindle = passo::read_spindle(reader);
  const TomlEntry* const bus = reader.table("modbus", "a table [spindle.modbus]", Need::optional);
  finish(reader);
  const auto end = [this](TableReader& inner) { finish(inner); };
  if (bus != nullptr) machine_.spindle.modbus = read_spindle_bus(*bus, machine_.tool.highest_rpm, reporter_, end);
}

void MachineReader::read_silence(const TomlEntry& entry) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "silence", entry.place, reporter_);
  passo::read_silence(reader, machine_.silence);
  finish(reader);
}

void MachineReader::look_at_work(const TomlEntry& entry) const {
  TableReader reader(std::get<TomlTable>(entry.value.content), "work", entry.place, reporter_);
  check_work(reader);
  finish(reader);
}

void MachineReader::read_pins(const TomlEntry* inputs, const TomlEntry* outputs) {
  if (inputs != nullptr) {
    TableReader reader(std::get<TomlTable>(inputs->value.content), "inputs", inputs->place, reporter_);
    read_inputs(reader, machine_.pins);
    finish(reader);
  }
  if (outputs != nullptr) {
    TableReader reader(std::get<TomlTable>(outputs->value.content), "outputs", outputs->place, reporter_);
    read_outputs(reader, machine_.pins);
    finish(reader);
  }
}

// Called when all axes are known.
void MachineReader::read_park_of(const TomlEntry& entry) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "park", entry.place, reporter_);
  machine_.park = read_park(reader, machine_.axes);
  finish(reader);
}

// Called when all axes are known.
void MachineReader::read_homing(const TomlEntry* entry) {
  std::optional<TableReader> reader;
  if (entry != nullptr) {
    reader.emplace(std::get<TomlTable>(entry->value.content), "homing", entry->place, reporter_);
  }
  HomingOrder order = read_homing_order(reader ? &*reader : nullptr, machine_.axes, homes_are_readable_);
  machine_.homing = std::move(order.axes);
  machine_.homing_turns = std::move(order.turns);
  if (reader) finish(*reader);
}

void MachineReader::read_axes(const TomlEntry& entry) {
  const auto& tables = std::get<TomlTable>(entry.value.content).entries;
  for (const TomlEntry& table : tables) {
    const auto axis = table.key.size() == 1 ? axis_of(table.key[0]) : std::nullopt;
    if (!axis || letter_of(*axis) != table.key[0]) {
      reporter_.error("machine.unknown-axis", table.place, machine_file_says::unknown_axis.with({{"name", table.key}}),
                      axis ? fmt::format("[axis.{}], with a capital letter", letter_of(*axis))
                           : "an axis X, Y, Z, A, B, C, U, V or W");
    } else if (!std::holds_alternative<TomlTable>(table.value.content)) {
      reporter_.error("machine.wrong-type", table.value.place,
                      toml_says::key_is.with({{"key", "axis." + table.key}, {"value", kind_of(table.value)}}),
                      fmt::format("a table [axis.{}]", table.key));
    } else {
      read_axis(table, *axis);
    }
  }
  if (tables.empty() && document_.complete) {
    reporter_.error("machine.no-axis", entry.place, machine_file_says::no_axis, machine_file_says::axis_table);
  }
  if (tables.size() > most_motors) {
    reporter_.error("machine.too-many-axes", tables[most_motors].place,
                    fmt::format("the machine has {} axes", tables.size()),
                    fmt::format("at most {}, the number of motors of a board", most_motors));
  }
  order_motors();
}

void MachineReader::read_axis(const TomlEntry& entry, Axis axis) {
  TableReader reader(std::get<TomlTable>(entry.value.content), fmt::format("axis.{}", entry.key), entry.place,
                     reporter_);
  AxisEntry& result = axes_.emplace_back();
  result.place = entry.place;
  AxisDescription& description = result.description;
  description.axis = axis;
  read_motion(reader, is_rotary(axis) ? rotary_keys : linear_keys, description);
  description.inverted = reader.flag("inverted").value_or(false);
  if (is_rotary(axis)) description.surface_radius = read_surface_radius(reader, axis);
  description.home = read_home_of(reader, description);
  const auto end = [this](TableReader& inner) { finish(inner); };
  description.screw = read_screw_of(reader, is_rotary(axis), reporter_, end);
  description.encoder = read_encoder_of(reader, is_rotary(axis), reporter_, end);
  read_second_of(reader, description);
  description.alarm_input = read_alarm_input(reader);
  if (const auto motor = reader.whole_number(motor_key, Need::optional)) {
    result.motor = static_cast<std::size_t>(*motor);
    result.motor_position = reader.place_of(motor_key.name);
  }
  if (reader.has(motor_key.name) && !result.motor) motors_are_readable_ = false;
  finish(reader);
}

std::optional<HomeDescription> MachineReader::read_home_of(TableReader& reader, const AxisDescription& axis) {
  const TomlEntry* home = reader.table(home_table, "a table [axis.X.home] with its switch", Need::optional);
  if (home == nullptr) return std::nullopt;
  TableReader own(std::get<TomlTable>(home->value.content), reader.full_name(home_table), home->place, reporter_);
  auto description = read_home(own, axis);
  finish(own);
  homes_are_readable_ &= description.has_value();
  return description;
}

void MachineReader::read_second_of(TableReader& reader, AxisDescription& axis) {
  const TomlEntry* second = reader.table(second_table, "a table [axis.Y.second_motor]", Need::optional);
  if (second == nullptr) return;
  TableReader own(std::get<TomlTable>(second->value.content), reader.full_name(second_table), second->place, reporter_);
  axis.second = read_second_motor(own, axis);
  finish(own);
  if (!axis.second) homes_are_readable_ = false;
}

void MachineReader::read_motion(TableReader& reader, const AxisKeys& keys, AxisDescription& axis) {
  axis.steps_per_unit = read_scale(reader, keys, axis.axis);
  if (const auto travel = reader.low_high(keys.travel, Need::required)) {
    axis.travel_low = travel->low;
    axis.travel_high = travel->high;
    if (travel->low >= travel->high) {
      reader.error("machine.travel", keys.travel.name,
                   machine_file_says::goes_from_to.with({{"key", reader.full_name(keys.travel.name)},
                                                         {"low", fmt::format("{}", travel->low)},
                                                         {"high", fmt::format("{}", travel->high)}}),
                   machine_file_says::low_end_first);
    }
  }
  if (const auto velocity = reader.number(keys.velocity, Need::required)) axis.velocity = MmPerSecond(*velocity);
  read_acceleration(reader, keys, axis);
  if (const auto jerk = reader.number(keys.jerk, Need::optional)) axis.jerk = MmPerSecond3(*jerk);
  read_start_stop(reader, keys, axis);
  check_velocity(reader, keys, axis);
}

void MachineReader::read_start_stop(TableReader& reader, const AxisKeys& keys, AxisDescription& axis) {
  axis.start_stop = MmPerSecond(reader.number(keys.start_stop, Need::optional).value_or(0));
  if (axis.velocity == MmPerSecond(0) || axis.start_stop <= axis.velocity) return;
  reader.error(
      "machine.start-stop", keys.start_stop.name,
      machine_file_says::starts_too_fast.with({{"axis", std::string(1, letter_of(axis.axis))},
                                               {"speed", fmt::format("{:g} {}", axis.start_stop.value(), keys.unit)},
                                               {"most", fmt::format("{:g} {}", axis.velocity.value(), keys.unit)}}),
      fmt::format("{} = {:g} or less, the limit set by {}", keys.start_stop.name, axis.velocity.value(),
                  keys.velocity.name));
}

// The limit is a constant, or the motor's, or the lower one of both.
void MachineReader::read_acceleration(TableReader& reader, const AxisKeys& keys, AxisDescription& axis) const {
  const TomlEntry* torque = reader.table(torque_table, "a table [axis.X.torque] with the motor's data", Need::optional);
  const auto constant = reader.number(keys.acceleration, torque == nullptr ? Need::required : Need::optional);
  if (constant) axis.acceleration = MmPerSecond2(*constant);
  if (torque == nullptr) return;

  const std::string path = reader.full_name(torque_table);
  TableReader own(std::get<TomlTable>(torque->value.content), path, torque->place, reporter_);
  const auto unit_per_turn = way_of_a_turn(reader, keys, axis.axis);
  axis.motor = read_torque(own, is_rotary(axis.axis), unit_per_turn);
  finish(own);
  if (!unit_per_turn && !reader.has(keys.gear.name)) {
    own.error(
        "machine.torque", "", fmt::format("[{}] does not give the travel per motor revolution", path),
        fmt::format("the scale of [axis.{}], given by {} and {}", letter_of(axis.axis), turn_key.name, keys.gear.name));
  }
  if (!axis.motor) return;
  if (!axis.motor->limits_motion) {
    if (!constant) reader.missing(keys.acceleration.name, "a constant limit, because limits_motion is false");
    return;
  }
  const MmPerSecond2 at_rest = axis.motor->acceleration_at(MmPerSecond(0));
  axis.acceleration = constant ? std::min(axis.acceleration, at_rest) : at_rest;
  if (axis.velocity == MmPerSecond(0)) return;
  const MmPerSecond2 least(keys.acceleration.least);
  if (axis.acceleration_at(axis.velocity) >= least) return;
  const double fastest = axis.motor->fastest_with(least).value();
  reader.error("machine.too-weak", keys.velocity.name,
               machine_file_says::too_weak.with({{"speed", fmt::format("{:g} {}", axis.velocity.value(), keys.unit)},
                                                 {"axis", std::string(1, letter_of(axis.axis))}}),
               machine_file_says::stronger_motor.with(
                   {{"key", std::string(keys.velocity.name)}, {"most", fmt::format("{:.4g}", fastest)}}));
}

// Millimetres or degrees of the axis for one turn of the motor, if the file tells them.
std::optional<double> MachineReader::way_of_a_turn(const TableReader& reader, const AxisKeys& keys, Axis axis) {
  const std::optional<double> gear = reader.peek(keys.gear);
  if (!gear) return std::nullopt;
  return is_rotary(axis) ? 360 / *gear : *gear;
}

// Steps a millimetre or degree. The file gives them directly, or by motor and gear. 0 where neither is right.
double MachineReader::read_scale(TableReader& reader, const AxisKeys& keys, Axis axis) const {
  const NumberKey* const gear_keys[] = {&turn_key, &microsteps_key, &keys.gear};
  const auto by_gear = std::ranges::find_if(gear_keys, [&](const NumberKey* key) { return reader.has(key->name); });
  const bool has_gear = by_gear != std::end(gear_keys);
  const bool has_scale = reader.has(keys.scale.name);

  const auto scale = reader.number(keys.scale, Need::optional);
  const auto turn = reader.number(turn_key, has_gear && !has_scale ? Need::required : Need::optional);
  const auto microsteps = reader.whole_number(microsteps_key, Need::optional);
  const auto gear = reader.number(keys.gear, has_gear && !has_scale ? Need::required : Need::optional);

  if (has_gear && has_scale) {
    reader.error("machine.two-scales", (*by_gear)->name,
                 machine_file_says::both_given.with(
                     {{"first", reader.full_name((*by_gear)->name)}, {"second", std::string(keys.scale.name)}}),
                 fmt::format("either {}, or {}, {} and {}", keys.scale.name, turn_key.name, microsteps_key.name,
                             keys.gear.name));
    return 0;
  }
  if (!has_gear) {
    if (!has_scale) {
      reader.missing(keys.scale.name, fmt::format("{} = {}, or {} and {}", keys.scale.name, keys.scale.example,
                                                  turn_key.name, keys.gear.name));
    }
    return scale.value_or(0);
  }
  const bool microsteps_wrong = reader.has(microsteps_key.name) && !microsteps;
  if (!turn || !gear || microsteps_wrong) return 0;
  const double motor_steps = *turn * microsteps.value_or(1);
  // A screw moves its pitch in one turn of the motor; a rotary axis turns once for `gear` turns of the motor.
  return is_rotary(axis) ? motor_steps * *gear / 360 : motor_steps / *gear;
}

void MachineReader::check_velocity(const TableReader& reader, const AxisKeys& keys, const AxisDescription& axis) const {
  if (!event_rate_ || axis.steps_per_unit == 0 || axis.velocity.value() == 0) return;
  const double steps = axis.highest_step_rate().value();
  if (steps <= event_rate_->value() * (1 + 1e-9)) return;
  reader.error("machine.too-fast", keys.velocity.name,
               machine_file_says::too_fast.with({{"axis", std::string(1, letter_of(axis.axis))},
                                                 {"steps", fmt::format("{:.0f}", steps)},
                                                 {"speed", fmt::format("{:g} {}", axis.velocity.value(), keys.unit)},
                                                 {"most", fmt::format("{:g}", event_rate_->value())}}),
               fmt::format("{} = {:g} or less, fewer microsteps, or a faster board", keys.velocity.name,
                           event_rate_->value() / axis.steps_per_unit));
}

// Orders the motors by their numbers if the file gives them, else in the order X Y Z A B C U V W.
void MachineReader::order_motors() {
  std::ranges::stable_sort(axes_, {}, [](const AxisEntry& entry) { return index_of(entry.description.axis); });
  const bool numbered = std::ranges::any_of(axes_, [](const AxisEntry& entry) { return entry.motor.has_value(); });
  if (numbered && motors_are_readable_) number_motors();
  for (const AxisEntry& entry : axes_) {
    std::optional<HomeDescription>& home = machine_.axes.emplace_back(entry.description).home;
    if (home && home->input < 0) home->input = static_cast<int>(machine_.axes.size()) - 1;
  }
  number_second_motors();
  for (std::size_t i = 0; i < axes_.size(); ++i) check_alarm_input(reporter_, axes_[i].place, machine_, i);
}

void MachineReader::number_second_motors() {
  if (machine_.axes.size() <= most_motors && machine_.motor_count() > most_motors) {
    reporter_.error("machine.motor", axes_.back().place,
                    fmt::format("the machine has {} motors", machine_.motor_count()),
                    fmt::format("at most {}, including second motors", most_motors));
  }
  for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
    AxisDescription& axis = machine_.axes[i];
    if (!axis.second) continue;
    if (axis.second->input < 0) axis.second->input = machine_.second_motor_of(i);
    if (!axis.home || axis.second->input != axis.home->input) continue;
    reporter_.error("machine.homing", axes_[i].place,
                    machine_file_says::shared_switch.with(
                        {{"axis", std::string(1, letter_of(axis.axis))}, {"input", std::to_string(axis.home->input)}}),
                    "a separate switch for each motor: input in [axis.X.home] and in [axis.X.second_motor]");
  }
}

void MachineReader::number_motors() {
  std::vector<const AxisEntry*> taken(axes_.size(), nullptr);
  bool good = true;
  for (const AxisEntry& entry : axes_) {
    const char letter = letter_of(entry.description.axis);
    if (!entry.motor) {
      reporter_.error("machine.motor", entry.place,
                      machine_file_says::motor_missing.with({{"axis", std::string(1, letter)}}),
                      machine_file_says::motors_for_all);
      good = false;
    } else if (*entry.motor >= axes_.size()) {
      reporter_.error(
          "machine.motor", entry.motor_position,
          machine_file_says::no_such_motor.with(
              {{"axis", std::string(1, letter)}, {"motor", std::to_string(*entry.motor)}}),
          fmt::format("0 to {}: the motors of {} axes, numbered without a gap", axes_.size() - 1, axes_.size()));
      good = false;
    } else if (taken[*entry.motor] != nullptr) {
      reporter_.error("machine.motor", entry.motor_position,
                      machine_file_says::motor_taken.with(
                          {{"motor", std::to_string(*entry.motor)},
                           {"axis", std::string(1, letter_of(taken[*entry.motor]->description.axis))}}),
                      machine_file_says::own_motor);
      good = false;
    } else {
      taken[*entry.motor] = &entry;
    }
  }
  if (good) std::ranges::stable_sort(axes_, {}, [](const AxisEntry& entry) { return *entry.motor; });
}

}  // namespace

MachineDescription read_machine(const TomlDocument& document, const TomlReporter& reporter, MachineUse use) {
  return MachineReader(document, reporter, use).read();
}

}  // namespace passo
