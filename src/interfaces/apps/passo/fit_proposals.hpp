// Proposals: what would make a program run on this machine that does not run on it as it is.
//
// Each proposal is verified before it is told: the program was checked once more, by the same code, with that change.
//
//   beyond the travel     another work zero, as the G10 L2 that sets it; or which axis is too short, and by how much
//   tools are missing     the lines for the tool table
//   a thread is too fast  a slower spindle
//   S above the limit     the spindle's highest speed, with feeds that leave each tooth its chip
//   steps are lost        slower feeds or rapids, as an override
#pragma once

#include <string>
#include <vector>

#include "check_page.hpp"
#include <nlohmann/json.hpp>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct Proposal {
  std::string kind;  // "work-zero", "axis-too-short", "tools", "spindle-speed", "override"
  std::string words;
  nlohmann::ordered_json values;  // more keys for programs
};

struct Unfit {
  const ProgramReader& program;
  const MachineDescription& machine;
  const InterpreterOptions& options;
};

// `page`: what the check of a good program has judged. Null: the motors are not asked. Up to six times the time of a
// check.
std::vector<Proposal> proposals_of(const Unfit& unfit, const ProgramCheck& check, const Diagnostics& findings,
                                   const CheckPage* page);

// A line for each, with a line end.
std::string to_text(const std::vector<Proposal>& proposals);
nlohmann::ordered_json as_json(const std::vector<Proposal>& proposals);

}  // namespace passo
