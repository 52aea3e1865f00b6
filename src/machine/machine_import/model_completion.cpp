#include "model_completion.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_imported_motors = 8;
constexpr double least_event_rate = 1000;
constexpr double most_event_rate = 1e7;

// As in the readers of machine files.
struct AllowedRange {
  double least;
  double most;
};
constexpr AllowedRange allowed_scale{1e-3, 1e6};
constexpr AllowedRange allowed_velocity{1e-3, 1e5};
constexpr AllowedRange allowed_acceleration{1e-3, 1e6};
constexpr AllowedRange allowed_pull_off{1e-3, 1e3};

bool lies_in(const DecimalNumber& number, AllowedRange range) {
  return number.value() >= range.least && number.value() <= range.most;
}

double farthest(Axis axis) {
  return is_rotary(axis) ? 1e7 : 1e5;
}

const char* unit_name(Axis axis) {
  return is_rotary(axis) ? "deg" : "mm";
}

class ModelCompletion {
 public:
  ModelCompletion(ImportedModel& model, ImportContext& context) : model_(model), context_(context) {}

  std::optional<ImportedBoard> complete() {
    if (!check_axes()) return std::nullopt;
    std::ranges::stable_sort(model_.axes, {}, &ImportedAxis::axis);
    for (ImportedAxis& axis : model_.axes) complete_axis(axis);
    complete_numbers();
    if (context_.has_failed()) return std::nullopt;
    return choose_board();
  }

 private:
  bool check_axes();
  void complete_axis(ImportedAxis& axis);
  const char* expected_keys() const;
  void check_required(const ImportedAxis& axis, const std::optional<SourcedNumber>& number, AllowedRange range,
                      const char* what);
  void complete_travel(ImportedAxis& axis);
  void complete_home(ImportedAxis& axis);
  std::string refuse_home(const ImportedAxis& axis, ImportedHome& home);
  bool find_pull_off(const ImportedAxis& axis, ImportedHome& home);
  void limit_speed(const ImportedAxis& axis, SourcedNumber& speed, const SourcedNumber& most, const char* what,
                   const char* than);
  void complete_numbers();
  void drop_outside(std::optional<SourcedNumber>& number, AllowedRange range, const char* key);
  std::optional<ImportedBoard> choose_board();
  double highest_step_rate() const;

  ImportedModel& model_;
  ImportContext& context_;
};

bool ModelCompletion::check_axes() {
  if (context_.has_failed()) return false;
  if (model_.axes.empty()) {
    context_.error("import.no-axis", ValueOrigin{}, "this file describes no axis",
                   "the steps per millimetre, the velocity and the acceleration of at least one axis");
    return false;
  }
  std::size_t motors = model_.axes.size();
  for (const ImportedAxis& axis : model_.axes) motors += axis.second ? 1 : 0;
  if (motors > most_imported_motors) {
    context_.error("import.too-many-motors", ValueOrigin{}, fmt::format("the machine has {} motors", motors),
                   fmt::format("at most {}, including second motors", most_imported_motors));
    return false;
  }
  return true;
}

// The keys that each axis needs.
const char* ModelCompletion::expected_keys() const {
  switch (context_.result().format) {
    case ImportFormat::settings: return "for each axis its steps/mm, e.g. $100, rate, $110, and acceleration, $120";
    case ImportFormat::fluidnc: return "steps_per_mm, max_rate_mm_per_min and acceleration_mm_per_sec2 for each axis";
    case ImportFormat::linuxcnc:
      return "SCALE, MAX_VELOCITY and MAX_ACCELERATION for each joint, not in another file or in HAL";
    case ImportFormat::mach3: return "e.g. Steps0, Vel0 and Acc0 for each active axis";
  }
  return "";
}

void ModelCompletion::check_required(const ImportedAxis& axis, const std::optional<SourcedNumber>& number,
                                     AllowedRange range, const char* what) {
  if (!number) {
    // A text that is no number has been reported already.
    if (!context_.has_failed()) {
      context_.error("import.missing-key", ValueOrigin{},
                     fmt::format("the file does not give the {} of axis {}", what, letter_of(axis.axis)),
                     expected_keys());
    }
  } else if (!lies_in(number->value, range)) {
    context_.error("import.out-of-range", number->origin,
                   fmt::format("{} is {}, so the {} of axis {} would be {}", number->origin.key, number->origin.value,
                               what, letter_of(axis.axis), number->value.text()),
                   fmt::format("a value for {:g} to {:g} in the machine file", range.least, range.most));
  }
}

void ModelCompletion::complete_axis(ImportedAxis& axis) {
  if (axis.scale && axis.scale->value.value() < 0) {
    axis.scale->value = -axis.scale->value;
    axis.inverted = SourcedFlag{!(axis.inverted && axis.inverted->value), axis.scale->origin};
  }
  check_required(axis, axis.scale, allowed_scale, "scale");
  check_required(axis, axis.velocity, allowed_velocity, "maximum velocity");
  check_required(axis, axis.acceleration, allowed_acceleration, "acceleration");
  complete_travel(axis);
  if (context_.has_failed()) return;
  if (axis.home) complete_home(axis);
  if (axis.backlash && axis.backlash->value.value() == 0) {
    context_.unmapped(axis.backlash->origin, "there is no backlash to compensate");
    axis.backlash.reset();
  }
  drop_outside(axis.backlash, {0, 10}, "backlash");
}

// Without limits in the source, the axis gets the longest travel that a machine file can have.
void ModelCompletion::complete_travel(ImportedAxis& axis) {
  const double most = farthest(axis.axis);
  const auto whole = static_cast<std::int64_t>(most);
  const auto complete = [&](std::optional<SourcedNumber>& end, std::int64_t widest, const char* what) {
    const bool is_far = end && std::abs(end->value.value()) > most;
    if (end && !is_far) return;
    if (is_far) context_.unmapped(end->origin, fmt::format("it is farther than {} {}", whole, unit_name(axis.axis)));
    end = SourcedNumber{DecimalNumber(widest), {.key = {}, .value = {}, .reason = "the source does not limit it"}};
    context_.warn(fmt::format("axis {} has no {} limit in the source: write its true travel into the machine file",
                              letter_of(axis.axis), what));
  };
  complete(axis.low, -whole, "lower");
  complete(axis.high, whole, "upper");
  if (axis.low->value < axis.high->value) return;
  const ValueOrigin& origin = axis.high->origin.is_assumed() ? axis.low->origin : axis.high->origin;
  context_.error("import.travel", origin,
                 fmt::format("the travel of axis {} goes from {} to {}", letter_of(axis.axis), axis.low->value.text(),
                             axis.high->value.text()),
                 "a low end below the high end");
}

void ModelCompletion::limit_speed(const ImportedAxis& axis, SourcedNumber& speed, const SourcedNumber& most,
                                  const char* what, const char* than) {
  if (!(most.value < speed.value)) return;
  context_.warn(fmt::format("axis {}: the {} speed of homing, {} {}/s, is limited to its {}, {} {}/s",
                            letter_of(axis.axis), what, speed.value.text(), unit_name(axis.axis), than,
                            most.value.text(), unit_name(axis.axis)));
  speed.value = most.value;
}

void ModelCompletion::complete_home(ImportedAxis& axis) {
  ImportedHome& home = *axis.home;
  const std::string reason = refuse_home(axis, home);
  if (reason.empty()) return;
  for (const ValueOrigin* origin : {&home.is_high.origin, &home.switch_at.origin, &home.seek.origin, &home.latch.origin}) {
    if (!origin->is_assumed()) context_.unmapped(*origin, reason);
  }
  if (home.pull_off && !home.pull_off->origin.is_assumed()) context_.unmapped(home.pull_off->origin, reason);
  context_.warn(fmt::format("axis {} is not homed by the machine file: {}", letter_of(axis.axis), reason));
  axis.home.reset();
}

// Why the axis cannot be homed as the source says; empty: it can.
std::string ModelCompletion::refuse_home(const ImportedAxis& axis, ImportedHome& home) {
  if (!lies_in(home.seek.value, allowed_velocity)) return "the speed of homing is outside the range of a machine file";
  if (!lies_in(home.latch.value, allowed_velocity)) return "the latch speed is outside the range of a machine file";
  limit_speed(axis, home.seek, *axis.velocity, "seek", "maximum velocity");
  limit_speed(axis, home.latch, home.seek, "latch", "seek speed");
  if (std::abs(home.switch_at.value.value()) > farthest(axis.axis)) return "the switch is too far away";
  if (home.pull_off && !lies_in(home.pull_off->value, allowed_pull_off)) home.pull_off.reset();
  if (!home.pull_off && !find_pull_off(axis, home)) return "the axis would rest outside its travel after homing";
  const double off = home.pull_off->value.value();
  const double rest = home.is_high.value ? home.switch_at.value.value() - off : home.switch_at.value.value() + off;
  if (rest < axis.low->value.value() || rest > axis.high->value.value()) {
    return "the axis would rest outside its travel after homing";
  }
  return {};
}

// Just enough to be off the switch and within the travel.
bool ModelCompletion::find_pull_off(const ImportedAxis& axis, ImportedHome& home) {
  const DecimalNumber outside =
      home.is_high.value ? home.switch_at.value - axis.high->value : axis.low->value - home.switch_at.value;
  DecimalNumber off(1);
  if (off < outside) off = outside;
  if (!lies_in(off, allowed_pull_off)) return false;
  home.pull_off =
      SourcedNumber{off, {.key = {}, .value = {}, .reason = "the source does not say how far the axis leaves the switch"}};
  return true;
}

void ModelCompletion::drop_outside(std::optional<SourcedNumber>& number, AllowedRange range, const char* key) {
  if (!number || lies_in(number->value, range)) return;
  context_.unmapped(number->origin, fmt::format("{} would be {}, outside the range of a machine file, {:g} to {:g}", key,
                                                number->value.text(), range.least, range.most));
  number.reset();
}

void ModelCompletion::complete_numbers() {
  drop_outside(model_.step_pulse_us, {0.05, 1000}, "step_pulse_us");
  drop_outside(model_.direction_setup_us, {0, 15}, "direction_setup_us");
  drop_outside(model_.direction_hold_us, {0, 15}, "direction_hold_us");
  drop_outside(model_.max_rpm, {0, 65535}, "max_rpm");
  drop_outside(model_.run_up_s, {0, 1000}, "run_up_s");
  drop_outside(model_.enable_wait_s, {0, 10}, "enable_wait_s");
}

double ModelCompletion::highest_step_rate() const {
  double highest = 0;
  for (const ImportedAxis& axis : model_.axes) {
    highest = std::max(highest, axis.scale->value.value() * axis.velocity->value.value());
  }
  return highest;
}

// The board that the program has firmware for and that comes nearest; where none is fast enough, an imagined one.
std::optional<ImportedBoard> ModelCompletion::choose_board() {
  const double needed = highest_step_rate();
  constexpr double uno_rate = 150'000;
  constexpr double pico_rate = 500'000;
  ImportedBoard board;
  if (needed > most_event_rate) {
    context_.error("import.too-fast", ValueOrigin{},
                   fmt::format("the fastest axis needs {:.0f} steps/s", needed),
                   fmt::format("at most {:.0f} steps/s", most_event_rate));
    return std::nullopt;
  }
  double rate = pico_rate;
  if (model_.runs_on_uno && needed <= uno_rate) {
    rate = uno_rate;
    board.reason = "an Arduino Uno, as in examples/machines/uno.toml";
  } else if (needed <= pico_rate) {
    board.reason = "a Raspberry Pi Pico, as in examples/machines/pico.toml";
  } else {
    rate = std::ceil(needed / 1000) * 1000;
    board.clock_hz = rate > 1e6 ? 200'000'000 : 16'000'000;
    board.reason = fmt::format("no board of Passo makes the {:.0f} steps/s that this machine needs", needed);
    context_.warn("no board of Passo is as fast as this machine: the machine file is for checking programs only");
  }
  board.step_pulse_us = model_.step_pulse_us ? model_.step_pulse_us->value : DecimalNumber::of(2.5);
  // A pulse and a pause of the same length fit between two events.
  const double longest = std::floor(500'000 / board.step_pulse_us.value());
  if (rate > longest) {
    rate = std::max({longest, std::ceil(needed), least_event_rate});
    if (rate > longest) {
      const auto pulse = static_cast<std::int64_t>(std::floor(500'000 / rate * 1000));
      board.step_pulse_us = DecimalNumber(pulse).scaled(1, 1000);
      board.pulse_is_shortened = true;
    }
  }
  board.event_rate_hz = static_cast<std::int64_t>(rate);
  return board;
}

}  // namespace

std::optional<ImportedBoard> complete_model(ImportedModel& model, ImportContext& context) {
  return ModelCompletion(model, context).complete();
}

}  // namespace passo
