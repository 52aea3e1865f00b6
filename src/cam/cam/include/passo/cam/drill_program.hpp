// write_drill_program: the G-code of a drill plan.
//
// Holes are canned cycles (G81, with pecks G83) or plain moves; circles and slots are milled in turns that go down by
// `mill_step`, the last at full depth, counterclockwise (climb milling with a spindle that turns clockwise). Several
// tools are changed with M6 at the park place, with a message to the operator before. The program begins and ends at
// the park place, at the clearance height.
//
// Numbers are in mm (G21), inches (G20) or centimetres (ProgramUnits). The program's arcs are exact to the last digit
// written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/drill_plan.hpp"
#include "passo/cam/program_units.hpp"

namespace passo {

struct DrillProgramOptions {
  std::string name = {};                // of the program, for its first comment
  std::vector<std::string> files = {};  // of the drawings
  ProgramUnits units = ProgramUnits::mm;
  Nanometres clearance{2'000'000};            // height of the rapids above the board
  Nanometres depth{-2'000'000};               // below the board's face, negative
  std::optional<Nanometres> peck = {};        // depth of one peck; empty: none
  Nanometres mill_step{500'000};              // how deep a turn of a milled circle or slot goes
  Nanometres feed{100'000'000};               // a minute, down into a hole
  Nanometres mill_feed{150'000'000};          // a minute, along circles and slots
  std::optional<std::uint32_t> spindle = {};  // turns a minute; empty: the program leaves the spindle alone
  DrawnPoint park = {};                       // as in DrillOptions
  bool canned = true;                         // G81 and G83; else plain moves
};

// The program's text.
std::string write_drill_program(const DrillPlan& plan, const DrillProgramOptions& options);

}  // namespace passo
