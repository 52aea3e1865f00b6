// How well a machine finds its place again when it is homed several times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "homing_run.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// The places where the switch of an axis closed, measured from where it closed at the first homing, by the board's
// counts. Thousandths of a millimetre or of a degree.
struct AxisRepeats {
  Axis axis = Axis::x;
  double mean = 0;
  double spread = 0;  // from the lowest to the highest
  std::int64_t spread_steps = 0;
};

// One for each axis that every report has. The reports are of homings one after the other, without motion between them.
std::vector<AxisRepeats> repeats_of(const std::vector<HomingReport>& reports, const MachineDescription& machine);

// A line for an axis, without its end.
std::string words_of(const AxisRepeats& repeats);

}  // namespace passo
