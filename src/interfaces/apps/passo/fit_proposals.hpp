// Proposals: what would make a program run on this machine that does not run on it as it is.
//
// Each proposal is verified before it is told: the program was checked once more, by the same code, with that change.
//
//   beyond the travel   another work zero, as the G10 L2 that sets it; or which axis is too short, and by how much
//   steps are lost      slower feeds or rapids, as an override
#pragma once

#include <string>
#include <vector>

#include "check_page.hpp"
#include <nlohmann/json.hpp>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct Proposal {
  std::string kind;  // "work-zero", "axis-too-short", "override"
  std::string words;
  nlohmann::ordered_json values;  // more keys for programs
};

struct Unfit {
  const ProgramReader& program;
  const MachineDescription& machine;
  const InterpreterOptions& options;
};

// For a program that leaves the travel. Nothing where another work zero does not help, as for G53.
std::vector<Proposal> proposals_for_travel(const Unfit& unfit, const Diagnostics& findings);
// For a program without errors whose motors lose steps: see `page`. Up to five times the time of a check.
std::vector<Proposal> proposals_for_motors(const Unfit& unfit, const ProgramCheck& check, const CheckPage& page);

// A line for each, with a line end.
std::string to_text(const std::vector<Proposal>& proposals);
nlohmann::ordered_json as_json(const std::vector<Proposal>& proposals);

}  // namespace passo
