// write_mill_program: the G-code of a mill plan.
//
// For each run the cutter goes by rapids above its first place and down to 0.5 mm above the board or above the ground
// that is milled already, by the plunge feed into the board, along the run by the mill feed, and up. Arcs are G2 and
// G3. Several tools are changed with M6 at the park place, with a message to the operator before. The program begins
// and ends at the park place, at the clearance height, and ends with M5 and M2.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/mill_plan.hpp"
#include "passo/cam/program_units.hpp"

namespace passo {

struct MillProgramOptions {
  std::string name = {};                  // of the program, for its first comment
  std::string command = {};               // "passo cam isolate"
  std::vector<std::string> files = {};    // of the drawings
  std::vector<std::string> remarks = {};  // a comment each
  ProgramUnits units = ProgramUnits::mm;
  Nanometres clearance{2'000'000};            // height of the rapids above the board
  Nanometres feed{200'000'000};               // a minute, along the runs
  Nanometres plunge_feed{60'000'000};         // a minute, straight down
  std::optional<std::uint32_t> spindle = {};  // turns a minute; empty: the program leaves the spindle alone
  DrawnPoint park = {};                       // where the tool is at the start, at tool changes and at the end
};

// The program's text.
std::string write_mill_program(const MillPlan& plan, const MillProgramOptions& options);

// How far a place of the plan and of the program are apart, at most: half of the last digit, along X and Y.
inline constexpr Nanometres most_rounding{180};

}  // namespace passo
