// Homing as a command does it: the request, what is shown meanwhile, and what came of it in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "opened_machine.hpp"

#include "passo/activity/homing_path.hpp"

namespace passo {

struct HomingReport {
  std::vector<HomedAxis> axes;
  Seconds time{0};
  // What went wrong, a stable code and a sentence without a full stop; empty: nothing.
  std::string code;
  std::string message;
  std::optional<Axis> axis;  // that was being homed then
};

// The machine has been greeted. Ctrl-C brakes. `shows`: what it does, on standard error, where that is a terminal.
HomingReport home_machine(OpenedMachine& machine, bool shows);
// Why it is not homed; and why a machine file is none to home by.
std::string words_of(const HomingReport& report);
std::string words_without_homing(const std::string& machine_file);

}  // namespace passo
