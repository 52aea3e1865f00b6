// A machine that is homed: on a board, or virtual with its switches where the machine file has them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "board_run.hpp"

#include "passo/activity/homing_path.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/plant.hpp"

namespace passo {

struct HomingReport {
  std::vector<HomedAxis> axes;
  Point place;  // at rest, machine coordinates
  Seconds time{0};
  // What went wrong, a stable code and a sentence without a full stop; empty: nothing.
  std::string code;
  std::string message;
  std::optional<Axis> axis;  // that was being homed then
};

// Null: virtual, and `plant` is behind it. Ctrl-C brakes. `shows`: what it does, on standard error, where that is a
// terminal.
HomingReport home_machine(const MachineDescription& machine, BoardRun* board, Plant& plant, bool shows);
// Why it is not homed; and why a machine file is none to home by.
std::string words_of(const HomingReport& report);
std::string words_without_homing(const std::string& machine_file);

}  // namespace passo
