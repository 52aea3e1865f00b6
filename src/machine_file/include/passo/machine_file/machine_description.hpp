// MachineDescription: what a machine file (TOML) says, checked and in strong units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct AxisDescription {
  Axis axis = Axis::x;
  double steps_per_unit = 0;  // a millimetre, for a rotary axis a degree; always positive
  double travel_low = 0;      // machine coordinates
  double travel_high = 0;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  bool inverted = false;  // the motor turns the other way
};

struct BoardDescription {
  Hertz clock{16e6};               // ticks a second
  Hertz highest_event_rate{50e3};  // events a second
  Seconds step_pulse{2.5e-6};
};

struct ToolDescription {
  std::string name;
  double highest_rpm = 0;  // 0: a relay, on or off
  Mm diameter{0};
};

struct MachineDescription {
  std::string name;
  Mm path_tolerance{0.01};
  BoardDescription board;
  ToolDescription tool;
  std::vector<AxisDescription> axes;  // in the order of the board's motors
};

// Reads and checks a machine file. Everything that is wrong is in `diagnostics` (line, key, nearest key, what is
// missing); empty when there was any error.
std::optional<MachineDescription> load_machine_file(const std::string& path, Diagnostics& diagnostics);

}  // namespace passo
