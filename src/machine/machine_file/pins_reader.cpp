#include "pins_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

const char* const level_code = "machine.level";

// While it works, a host is heard five times a second.
constexpr double shortest_silence = 0.5;

constexpr NumberKey filter_key{"filter_us", 0, 250, "100"};
constexpr NumberKey drivers_off_key{"drivers_off_after_s", 0, 25.5, "20"};
constexpr NumberKey enable_wait_key{"enable_wait_s", 0, 10, "0.2"};
constexpr NumberKey silent_spindle_key{"spindle_off_after_s", 0, 25.5, "2"};
constexpr NumberKey silent_mist_key{"mist_off_after_s", 0, 25.5, "2"};
constexpr NumberKey silent_flood_key{"flood_off_after_s", 0, 25.5, "10"};
constexpr NumberKey spindle_wait_key{"spindle_wait_s", 0, 1000, "5"};
constexpr NumberKey clearance_key{"clearance_mm", 0.01, 1000, "5"};
constexpr NumberKey depth_key{"depth_mm", -1000, -0.001, "-2"};

void read_high(TableReader& reader, std::string_view key, bool& is_high) {
  is_high = reader.is_second_of(level_code, key, "low", "high", Need::optional).value_or(false);
}
void read_low(TableReader& reader, std::string_view key, bool& is_low) {
  is_low = reader.is_second_of(level_code, key, "high", "low", Need::optional).value_or(false);
}

// A time after which a silent host's outputs end: whole tenths of a second, or 0. Reports anything else.
void read_tenths(TableReader& reader, const NumberKey& key, Seconds& time) {
  const auto given = reader.number(key, Need::optional);
  if (!given) return;
  const double tenths = std::round(*given * 10);
  const bool is_whole = std::abs(*given * 10 - tenths) < 1e-6;
  if (*given != 0 && (*given < shortest_silence || !is_whole)) {
    reader.error("machine.silence", key.name, fmt::format("{} = {:g}", reader.full_name(key.name), *given),
                 fmt::format("{:g} to {:g} seconds in whole tenths, or 0 for never", shortest_silence, key.most));
    return;
  }
  time = Seconds(tenths / 10);
}

}  // namespace

void read_inputs(TableReader& reader, PinsDescription& pins) {
  const std::vector<bool> limits = reader.are_second_of(level_code, "limits", "low", "high", most_motors);
  for (std::size_t i = 0; i < limits.size(); ++i) pins.limits_high[i] = limits[i];
  read_high(reader, "probe", pins.probe_high);
  read_high(reader, "door", pins.door_high);
  read_high(reader, "emergency_stop", pins.emergency_stop_high);
  read_high(reader, "feed_hold", pins.feed_hold_high);
  read_high(reader, "cycle_start", pins.cycle_start_high);
  if (const auto filter = reader.whole_number(filter_key, Need::optional)) pins.filter = Seconds(*filter * 1e-6);
}

std::optional<int> read_alarm_input(TableReader& reader) {
  constexpr std::string_view key = "alarm_input";
  const auto name = reader.text(key, "limit 3", Need::optional);
  if (!name) return std::nullopt;
  if (*name == "feed_hold") return alarm_at_feed_hold;
  if (*name == "cycle_start") return alarm_at_cycle_start;
  for (int i = 0; i < static_cast<int>(most_motors); ++i) {
    if (*name == fmt::format("limit {}", i)) return i;
  }
  reader.error("machine.alarm-input", key, fmt::format("{} = \"{}\"", reader.full_name(key), *name),
               "\"limit 0\" to \"limit 7\", the pin of that limit switch, or \"feed_hold\" or \"cycle_start\"");
  return std::nullopt;
}

void check_alarm_input(const TomlReporter& reporter, const SourceLocation& place, const MachineDescription& machine,
                       std::size_t index) {
  const AxisDescription& axis = machine.axes[index];
  if (!axis.alarm_input || *axis.alarm_input >= static_cast<int>(most_motors)) return;
  const auto is_switch = [&](const AxisDescription& one) {
    return one.home && (one.home_switches() >> static_cast<unsigned>(*axis.alarm_input) & 1U) != 0;
  };
  const auto homed = std::ranges::find_if(machine.axes, is_switch);
  if (homed == machine.axes.end()) return;
  reporter.error("machine.alarm-input", place,
                 fmt::format("the drive alarm of axis {} is at limit {}, which is also the switch of axis {}",
                             letter_of(axis.axis), *axis.alarm_input, letter_of(homed->axis)),
                 "an input that is not a homing switch");
}

void read_outputs(TableReader& reader, PinsDescription& pins) {
  read_low(reader, "step", pins.step_low);
  read_high(reader, "driver_enable", pins.driver_enable_high);
  read_low(reader, "spindle", pins.spindle_low);
  read_low(reader, "spindle_reverse", pins.spindle_reverse_low);
  read_low(reader, "mist", pins.mist_low);
  read_low(reader, "flood", pins.flood_low);
  read_tenths(reader, drivers_off_key, pins.drivers_off_after);
  if (const auto wait = reader.number(enable_wait_key, Need::optional)) pins.enable_wait = Seconds(*wait);
}

void read_windings(TableReader& reader, BoardDescription& board) {
  const auto name = reader.text("windings", "half-step", Need::optional);
  if (!name) return;
  const auto excitation = Excitation::named(*name);
  if (excitation && !excitation->is_sine()) {
    board.windings = *excitation;
  } else {
    reader.error("machine.windings", "windings", fmt::format("windings = \"{}\"", *name),
                 "\"two-on\", \"wave\" or \"half-step\"; pins cannot set microsteps");
  }
}

void read_silence(TableReader& reader, SilenceDescription& silence) {
  read_tenths(reader, silent_spindle_key, silence.spindle);
  read_tenths(reader, silent_mist_key, silence.mist);
  read_tenths(reader, silent_flood_key, silence.flood);
  if (const auto wait = reader.number(spindle_wait_key, Need::optional)) silence.spindle_wait = Seconds(*wait);
}

void check_work(TableReader& reader) {
  for (const NumberKey& key : {clearance_key, depth_key}) static_cast<void>(reader.number(key, Need::optional));
}

}  // namespace passo
