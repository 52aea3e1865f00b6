// ImportedModel: what the configuration of a controller says about its machine, in the units of a machine file. The
// reader of each format fills it; write_machine_text() writes it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "decimal_number.hpp"

#include "passo/geometry/axes.hpp"

namespace passo {

// Where a value comes from. Without a key, it is assumed, and `reason` says why.
struct ValueOrigin {
  std::string key;    // "$110"
  std::string value;  // as it is written there
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::string reason = {};

  bool is_assumed() const { return key.empty(); }
};

template <class T>
struct Sourced {
  T value{};
  ValueOrigin origin;
};
using SourcedNumber = Sourced<DecimalNumber>;
using SourcedFlag = Sourced<bool>;

struct ImportedHome {
  SourcedFlag is_high;
  SourcedNumber switch_at;
  SourcedNumber seek;
  SourcedNumber latch;
  std::optional<SourcedNumber> pull_off;  // empty: the source does not say it
  int turn = 0;                           // axes with the same number seek their switches together; -1: unknown
  std::optional<ValueOrigin> turn_origin = {};
};

struct ImportedSecondMotor {
  ValueOrigin origin;
  std::optional<SourcedFlag> inverted = {};
  std::optional<SourcedFlag> limit_high = {};
};

// For A, B and C in degrees instead of millimetres.
struct ImportedAxis {
  Axis axis = Axis::x;
  std::optional<SourcedNumber> scale = {};  // not negative; 0 is an error
  std::optional<SourcedNumber> low = {};
  std::optional<SourcedNumber> high = {};
  std::optional<SourcedNumber> velocity = {};
  std::optional<SourcedNumber> acceleration = {};
  std::optional<SourcedNumber> backlash = {};
  std::optional<SourcedFlag> inverted = {};
  std::optional<SourcedFlag> limit_high = {};
  std::optional<ImportedHome> home = {};
  std::optional<ImportedSecondMotor> second = {};
};

// The pins that have a level in [inputs] or [outputs].
enum class ImportedPin : std::uint8_t {
  probe,
  door,
  emergency_stop,
  feed_hold,
  cycle_start,
  step,
  driver_enable,
  spindle,
  spindle_reverse,
  mist,
  flood,
};
inline constexpr std::size_t imported_pin_count = 11;

struct ImportedModel {
  Sourced<std::string> name;
  std::optional<ValueOrigin> core_xy = {};  // X and Y share two motors
  std::optional<SourcedNumber> step_pulse_us = {};
  std::optional<SourcedNumber> direction_setup_us = {};
  std::optional<SourcedNumber> direction_hold_us = {};
  bool runs_on_uno = false;  // Grbl 1.1; the others run on boards with 32 bits or on a computer
  std::optional<SourcedNumber> max_rpm = {};
  std::optional<SourcedNumber> run_up_s = {};
  std::optional<SourcedNumber> enable_wait_s = {};
  std::array<std::optional<SourcedFlag>, imported_pin_count> pin_is_high = {};
  std::vector<ImportedAxis> axes = {};  // each letter once

  std::optional<SourcedFlag>& pin(ImportedPin pin) { return pin_is_high[static_cast<std::size_t>(pin)]; }
  const std::optional<SourcedFlag>& pin(ImportedPin pin) const { return pin_is_high[static_cast<std::size_t>(pin)]; }
};

}  // namespace passo
