// ActiveModes: the active modes and offsets of a program, for display.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

struct ActiveModes {
  // One code of each group that Grbl reports, in Grbl's order: motion, work offset, plane, units, distances, feed mode.
  std::vector<std::string> codes;
  SpindleDirection spindle = SpindleDirection::off;
  double speed = 0;  // S
  bool mist = false;
  bool flood = false;
  std::int32_t tool = 0;
  double feed = 0;  // F, mm/min; in inverse time 1/min
  bool inches = false;
  Frame frame;
  Point position;  // the programmed position, machine coordinates
};

// A tool in the spindle that M6 has measured. The length is its offset: from the spindle's nose, or the difference to
// the first tool.
struct ToolMeasurement {
  std::int32_t number = 0;
  double length = 0;  // mm
  friend bool operator==(const ToolMeasurement&, const ToolMeasurement&) = default;
};

}  // namespace passo
