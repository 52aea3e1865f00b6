// GrblSettings: grbl's numbered settings ($0 … $132), as far as a machine file has their values.
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

// What a sender may choose for itself; nothing of it is in a machine file.
struct GrblChoices {
  unsigned status_mask = 3;  // $10: bit 0 machine positions, else work positions; bit 1 the buffers
  bool inches = false;       // $13: reports are in inches
  friend bool operator==(const GrblChoices&, const GrblChoices&) = default;
};

// In the order of their numbers.
std::vector<GrblSetting> grbl_settings(const MachineDescription& machine, const GrblChoices& choices);

// True: the setting has that value, as far as senders are shown it.
bool has_setting(const MachineDescription& machine, const GrblChoices& choices, int number, double value);

// The axes of reports: X, Y and Z always, because senders expect them; then the machine's others, six at most.
std::vector<Axis> grbl_axes_of(const MachineDescription& machine);

// The letters of those beside X, Y and Z, for InterpreterOptions::more_grbl_axes.
std::string more_grbl_axes(const MachineDescription& machine);

// The number of a setting's axis: $100 is the first axis of grbl_axes_of(). Null: that axis is not on the machine.
const AxisDescription* axis_of_setting(const MachineDescription& machine, int number);

}  // namespace passo
