// The texts that a Grbl controller sends, in the format of grbl 1.1. Each is one or more whole lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/grbl/grbl_settings.hpp"
#include "passo/interpreter/active_modes.hpp"
#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/probe_outcome.hpp"
#include "passo/path/segment.hpp"

namespace passo {

// The contents of a status report.
struct GrblStatus {
  std::string_view state;  // "Idle", "Hold:0" …
  Point machine_place;
  Point work_offset;  // machine position minus work position
  std::size_t planner_free = 0;
  std::size_t bytes_free = 0;
  double feed = 0;  // mm/min, actual
  double speed = 0;
  std::int64_t line_number = -1;  // N word of the current line; below 1: none
  std::string pins;               // letters of the triggered inputs
  OutputState outputs;
  int feed_override = 100;  // percent
  int rapid_override = 100;
  int spindle_override = 100;
  bool shows_offset = false;
  bool shows_overrides = false;
};

// The format of positions: which axes, and whether in inches.
struct GrblUnits {
  std::vector<Axis> axes;
  bool inches = false;
};

inline constexpr std::string_view grbl_banner = "\r\nGrbl 1.1h ['$' for help]\r\n";
inline constexpr std::size_t grbl_planner_blocks = 15;

std::string places_text(const Point& place, const GrblUnits& units);
std::string status_text(const GrblStatus& status, const GrblUnits& units, unsigned mask);
// Returns the response to $G.
std::string modes_text(const ActiveModes& modes, const GrblUnits& units);
// Returns the response to $#.
std::string offsets_text(const SavedParameters& parameters, const ActiveModes& modes,
                         const std::optional<ProbeOutcome>& probe, const GrblUnits& units);
std::string probe_text(const std::optional<ProbeOutcome>& probe, const GrblUnits& units);
// $I, with the build info stored for this machine
std::string build_text(std::string_view words);
// What $I+ tells in addition, in the words of grblHAL. $I is that of Grbl 1.1h: senders take a controller with these
// lines for another one.
std::string more_build_text(std::string_view axes);
std::string axis_letters(const std::vector<Axis>& axes);
// Returns the response to $.
std::string help_text();

}  // namespace passo
