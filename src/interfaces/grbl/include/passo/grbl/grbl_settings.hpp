// GrblSettings: grbl's numbered settings ($0 … $132), as far as the machine file has corresponding values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct GrblSetting {
  int number = 0;
  std::string value;
};

// The settings that a sender may change for itself; they are not in a machine file.
struct GrblChoices {
  unsigned status_mask = 3;  // $10: bit 0 machine positions, otherwise work positions; bit 1 the buffer state
  bool inches = false;       // $13: reports are in inches
  friend bool operator==(const GrblChoices&, const GrblChoices&) = default;
};

// Returns the settings in the order of their numbers.
std::vector<GrblSetting> grbl_settings(const MachineDescription& machine, const GrblChoices& choices);

// Returns whether the setting has that value, within the precision shown to senders.
bool has_setting(const MachineDescription& machine, const GrblChoices& choices, int number, double value);

// Returns the axes of reports: always X, Y and Z, because senders expect them; then the machine's other axes, at most
// six in total.
std::vector<Axis> grbl_axes_of(const MachineDescription& machine);

// Returns the letters of the axes other than X, Y and Z, for InterpreterOptions::more_grbl_axes.
std::string more_grbl_axes(const MachineDescription& machine);

// Returns the axis of a setting: $100 is the first axis of grbl_axes_of(). Null if the machine does not have that axis.
const AxisDescription* axis_of_setting(const MachineDescription& machine, int number);

}  // namespace passo
