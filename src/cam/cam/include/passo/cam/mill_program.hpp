// write_mill_program: writes a mill plan as G-code.
//
// For each run the cutter rapids to the XY position of the first point and down to 0.5 mm above the board, plunges at
// the plunge feed, follows the run at the feeds of its paces, and retracts. A run that begins with a rapid is entered
// by this rapid. Arcs are G2 and G3. The program begins with a rapid up to the change height, and reaches the first run
// from there. Multiple tools are changed with M6 at the change height above the park position, with the spindle off,
// after a message to the operator. The program ends there too, with M5 and M2.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/mill_plan.hpp"
#include "passo/cam/program_units.hpp"
#include "passo/cam/safe_change.hpp"

namespace passo {

struct MillProgramOptions {
  std::string name = {};                  // program name, for the first comment
  std::string command = {};               // "passo cam isolate"
  std::vector<std::string> files = {};    // names of the drawing files
  std::vector<std::string> remarks = {};  // comments at the head of the program
  ProgramUnits units = ProgramUnits::mm;
  Nanometres clearance{2'000'000};             // clearance height above the board
  Nanometres feed{200'000'000};                // cutting feed, nm/min
  std::optional<Nanometres> finish_feed = {};  // feed of finishing passes; empty: `feed`
  std::optional<Nanometres> link_feed = {};    // feed of links through cleared areas; empty: usual_link_feed()
  Nanometres plunge_feed{60'000'000};          // plunge feed, nm/min; descents along the way are no faster
  std::optional<std::uint32_t> spindle = {};   // rpm; empty: no spindle commands
  DrawnPoint park = {};                        // tool position at tool changes and at the end
  SafeChange change = {};
};

// Four times the feed, and at least 1500 mm/min.
Nanometres usual_link_feed(Nanometres feed);

// Returns the program text.
std::string write_mill_program(const MillPlan& plan, const MillProgramOptions& options);

// The maximum distance between a point of the plan and the same point of the program: half of the last digit, in X and
// Y.
inline constexpr Nanometres most_rounding{180};

}  // namespace passo
