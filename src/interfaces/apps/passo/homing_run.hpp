// Homing by a command: the request, the progress display, and the result as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "machine_connection.hpp"

#include "passo/activity/homing_path.hpp"

namespace passo {

struct HomingReport {
  std::vector<HomedAxis> axes;
  Seconds time{0};
  // The error: a stable code, and a sentence without a full stop. Both are empty if the machine is homed.
  std::string code;
  std::string message;
  std::optional<Axis> axis;  // the axis that was being homed when the error occurred
};

// Homes a connected machine. Ctrl-C brakes. With `shows`, shows the progress on standard error if that is a terminal.
HomingReport home_machine(MachineConnection& machine, bool shows);
// describe() explains why the machine is not homed. words_without_homing() explains why a machine with this file cannot
// be homed.
std::string describe(const HomingReport& report);
std::string words_without_homing(const std::string& machine_file);

}  // namespace passo
