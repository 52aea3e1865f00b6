#include "machine_text.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t comment_column = 32;

std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

const char* level_of(bool high) {
  return high ? "\"high\"" : "\"low\"";
}

class MachineText {
 public:
  MachineText(const ImportedModel& model, const ImportedBoard& board, ImportContext& context)
      : model_(model), board_(board), context_(context) {}

  std::string write();

 private:
  void open(std::string table);
  void put(const std::string& key, const std::string& value, const ValueOrigin& origin);
  void put(const std::string& key, const std::optional<SourcedNumber>& number) {
    if (number) put(key, number->value.text(), number->origin);
  }
  void write_board();
  void write_tool_and_spindle();
  void write_inputs();
  void write_outputs();
  void write_pin(const char* key, ImportedPin pin, bool usual_is_high);
  void write_limits();
  void write_homing_order();
  std::string homing_order() const;
  void write_axis(const ImportedAxis& axis);
  void write_travel(const ImportedAxis& axis, const char* unit);
  void write_home(const ImportedAxis& axis, const char* unit);
  void write_second(const ImportedAxis& axis);

  const ImportedModel& model_;
  const ImportedBoard& board_;
  ImportContext& context_;
  std::string text_;
  std::string table_;           // the table of the lines that follow
  bool table_is_open_ = false;  // whether its header is written
};

void MachineText::open(std::string table) {
  table_ = std::move(table);
  table_is_open_ = false;
}

void MachineText::put(const std::string& key, const std::string& value, const ValueOrigin& origin) {
  if (!table_is_open_ && !table_.empty()) text_ += fmt::format("\n[{}]\n", table_);
  table_is_open_ = true;
  const std::string line = fmt::format("{} = {}", key, value);
  const std::string comment =
      origin.is_assumed() ? "assumed: " + origin.reason : fmt::format("{} = {}", origin.key, origin.value);
  text_ += fmt::format("{:<{}}# {}\n", line + ' ', comment_column, ImportContext::printable(comment));
  const std::string target = table_.empty() ? line : fmt::format("{}.{}", table_, line);
  if (origin.is_assumed()) {
    context_.assumed(target, origin.reason);
  } else {
    context_.understood(origin, target);
  }
}

std::string MachineText::write() {
  text_ = fmt::format(
      "# Made by passo machine --from, from the configuration of {}. A value marked \"assumed\" is not in that\n"
      "# configuration: check it. Every key is explained in docs/manual/machine-file.md.\n\n",
      context_.result().controller);
  put("name", toml_text(model_.name.value), model_.name.origin);
  if (model_.core_xy) put("kinematics", "\"corexy\"", *model_.core_xy);
  write_board();
  write_tool_and_spindle();
  write_inputs();
  write_outputs();
  write_homing_order();
  for (const ImportedAxis& axis : model_.axes) write_axis(axis);
  return std::move(text_);
}

void MachineText::write_board() {
  open("board");
  const ValueOrigin assumed{.key = {}, .value = {}, .reason = board_.reason};
  put("clock_hz", fmt::format("{}", board_.clock_hz), assumed);
  put("max_event_rate_hz", fmt::format("{}", board_.event_rate_hz), assumed);
  const std::string pulse = board_.step_pulse_us.text();
  if (!model_.step_pulse_us) {
    put("step_pulse_us", pulse, {.key = {}, .value = {}, .reason = "the usual value"});
  } else {
    put("step_pulse_us", pulse, model_.step_pulse_us->origin);
    if (board_.pulse_is_shortened) {
      context_.warn(
          fmt::format("a step pulse of {} us and a pause of the same length do not fit into the highest step rate: "
                      "step_pulse_us = {} "
                      "instead; check what the drivers require",
                      model_.step_pulse_us->value.text(), pulse));
    }
  }
  put("direction_setup_us", model_.direction_setup_us);
  put("direction_hold_us", model_.direction_hold_us);
}

void MachineText::write_tool_and_spindle() {
  open("tool");
  put("max_rpm", model_.max_rpm);
  open("spindle");
  put("run_up_s", model_.run_up_s);
}

void MachineText::write_pin(const char* key, ImportedPin pin, bool usual_is_high) {
  const auto& level = model_.pin(pin);
  if (!level) return;
  if (level->value != usual_is_high) {
    put(key, level_of(level->value), level->origin);
  } else {
    context_.understood(level->origin, fmt::format("{}.{} = {} (the default)", table_, key, level_of(level->value)));
  }
}

// The limit switches are numbered like the motors: first one of each axis, then the second motors.
void MachineText::write_limits() {
  std::vector<const std::optional<SourcedFlag>*> limits;
  for (const ImportedAxis& axis : model_.axes) limits.push_back(&axis.limit_high);
  for (const ImportedAxis& axis : model_.axes) {
    if (axis.second) limits.push_back(&axis.second->limit_high);
  }
  std::string list;
  const ValueOrigin* origin = nullptr;
  for (const auto* limit : limits) {
    const bool high = *limit && (*limit)->value;
    list += fmt::format("{}{}", list.empty() ? "" : ", ", level_of(high));
    if (high && origin == nullptr) origin = &(*limit)->origin;
  }
  if (origin != nullptr) put("limits", fmt::format("[{}]", list), *origin);
  for (const auto* limit : limits) {
    if (!*limit || &(*limit)->origin == origin) continue;
    const bool high = (*limit)->value;
    context_.understood((*limit)->origin,
                        fmt::format("inputs.limits: {}{}", level_of(high), origin == nullptr ? " (the default)" : ""));
  }
}

void MachineText::write_inputs() {
  open("inputs");
  write_limits();
  write_pin("probe", ImportedPin::probe, false);
  write_pin("door", ImportedPin::door, false);
  write_pin("emergency_stop", ImportedPin::emergency_stop, false);
  write_pin("feed_hold", ImportedPin::feed_hold, false);
  write_pin("cycle_start", ImportedPin::cycle_start, false);
}

void MachineText::write_outputs() {
  open("outputs");
  write_pin("step", ImportedPin::step, true);
  write_pin("driver_enable", ImportedPin::driver_enable, false);
  write_pin("spindle", ImportedPin::spindle, true);
  write_pin("spindle_reverse", ImportedPin::spindle_reverse, true);
  write_pin("mist", ImportedPin::mist, true);
  write_pin("flood", ImportedPin::flood, true);
  put("enable_wait_s", model_.enable_wait_s);
}

// Axes of the same turn seek their switches together, unless one of them is rotary or has two motors.
std::string MachineText::homing_order() const {
  std::vector<const ImportedAxis*> homed;
  for (const ImportedAxis& axis : model_.axes) {
    if (axis.home) homed.push_back(&axis);
  }
  std::ranges::stable_sort(homed, {},
                           [](const ImportedAxis* axis) { return axis->home->turn < 0 ? 1000 : axis->home->turn; });
  std::string order;
  for (std::size_t i = 0; i < homed.size();) {
    std::size_t end = i + 1;
    const int turn = homed[i]->home->turn;
    while (turn >= 0 && end < homed.size() && homed[end]->home->turn == turn) ++end;
    const bool together =
        end - i > 1 &&
        std::all_of(homed.begin() + static_cast<std::ptrdiff_t>(i), homed.begin() + static_cast<std::ptrdiff_t>(end),
                    [](const ImportedAxis* axis) { return !is_rotary(axis->axis) && !axis->second; });
    for (const char* between = order.empty() ? "" : " "; i < end; ++i, between = together ? "" : " ") {
      order += between;
      if (together && (*between != '\0' || order.empty())) order += '(';
      order += letter_of(homed[i]->axis);
    }
    if (together) order += ')';
  }
  return order;
}

void MachineText::write_homing_order() {
  open("homing");
  const ValueOrigin* origin = nullptr;
  const std::string order = homing_order();
  for (const ImportedAxis& axis : model_.axes) {
    if (!axis.home || !axis.home->turn_origin) continue;
    if (origin == nullptr) {
      origin = &*axis.home->turn_origin;
      put("order", toml_text(order), *origin);
    } else {
      context_.understood(*axis.home->turn_origin, fmt::format("homing.order = \"{}\"", order));
    }
  }
}

void MachineText::write_travel(const ImportedAxis& axis, const char* unit) {
  const std::string value = fmt::format("[{}, {}]", axis.low->value.text(), axis.high->value.text());
  const ValueOrigin& low = axis.low->origin;
  const ValueOrigin& high = axis.high->origin;
  const ValueOrigin& shown = low.is_assumed() ? high : low;
  const std::string key = fmt::format("travel_{}", unit);
  put(key, value, shown);
  const ValueOrigin& other = low.is_assumed() ? low : high;
  if (other.is_assumed()) {
    if (!shown.is_assumed()) context_.assumed(fmt::format("{}.{} = {}", table_, key, value), other.reason);
  } else if (other.key != shown.key) {
    context_.understood(other, fmt::format("{}.{} = {}", table_, key, value));
  }
}

void MachineText::write_axis(const ImportedAxis& axis) {
  const std::string table = fmt::format("axis.{}", letter_of(axis.axis));
  const char* const unit = is_rotary(axis.axis) ? "deg" : "mm";
  open(table);
  put(fmt::format("steps_per_{}", unit), axis.scale);
  write_travel(axis, unit);
  put(fmt::format("max_velocity_{}_s", unit), axis.velocity);
  put(fmt::format("max_acceleration_{}_s2", unit), axis.acceleration);
  if (axis.inverted && axis.inverted->value) {
    put("inverted", "true", axis.inverted->origin);
  } else if (axis.inverted) {
    context_.understood(axis.inverted->origin, fmt::format("{}.inverted = false (the default)", table));
  }
  if (axis.home) {
    open(table + ".home");
    write_home(axis, unit);
  }
  if (axis.backlash) {
    open(table + ".screw");
    put(fmt::format("backlash_{}", unit), axis.backlash);
  }
  if (axis.second) {
    open(table + ".second_motor");
    write_second(axis);
  }
}

void MachineText::write_home(const ImportedAxis& axis, const char* unit) {
  const ImportedHome& home = *axis.home;
  put("direction", home.is_high.value ? "\"high\"" : "\"low\"", home.is_high.origin);
  put(fmt::format("switch_at_{}", unit), home.switch_at.value.text(), home.switch_at.origin);
  put(fmt::format("seek_{}_s", unit), home.seek.value.text(), home.seek.origin);
  put(fmt::format("latch_{}_s", unit), home.latch.value.text(), home.latch.origin);
  put(fmt::format("pull_off_{}", unit), home.pull_off);
}

void MachineText::write_second(const ImportedAxis& axis) {
  const ImportedSecondMotor& second = *axis.second;
  const bool as_first = axis.inverted && axis.inverted->value;
  if (second.inverted) {
    put("inverted", second.inverted->value ? "true" : "false", second.inverted->origin);
  } else {
    put("inverted", as_first ? "true" : "false", second.origin);
  }
}

}  // namespace

std::string write_machine_text(const ImportedModel& model, const ImportedBoard& board, ImportContext& context) {
  return MachineText(model, board, context).write();
}

}  // namespace passo
