// write_drill_program: writes a drill plan as G-code.
//
// Holes use canned cycles (G81, or G83 for pecking) or plain moves. Rapids lead from the clearance height down to the
// feed height, and at the feed height to the next hole if it is within 5 mm. Circles and slots are milled
// counterclockwise (climb milling for a clockwise spindle) in passes of `mill_step`, with a final pass at full depth.
// The program begins with a rapid up to the change height, and reaches the first hole from there. Multiple tools are
// changed with M6 at the change height above the park position, with the spindle off, after a message to the operator.
// The program ends there too.
//
// Numbers are in mm (G21), inches (G20) or centimetres (ProgramUnits). Arcs are exact to the last written digit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/drill_plan.hpp"
#include "passo/cam/program_units.hpp"
#include "passo/cam/safe_change.hpp"

namespace passo {

// The feed of a drill that differs from that of the others.
struct DrillFeed {
  Nanometres diameter = {};
  Nanometres feed = {};                       // nm/min
  std::optional<std::uint32_t> spindle = {};  // rpm; empty: as DrillProgramOptions::spindle
};

struct DrillProgramOptions {
  std::string name = {};                  // program name, for the first comment
  std::vector<std::string> files = {};    // names of the drawing files
  std::vector<std::string> remarks = {};  // comments at the head of the program
  ProgramUnits units = ProgramUnits::mm;
  Nanometres clearance{2'000'000};            // clearance height above the board
  Nanometres feed_height{500'000};            // height above the board at which the feed begins, at most `clearance`
  Nanometres depth{-2'000'000};               // depth of the holes below the board's surface, negative
  std::optional<Nanometres> peck = {};        // depth of one peck; empty: no pecking
  Nanometres mill_step{500'000};              // depth per pass of a milled circle or slot
  Nanometres feed{100'000'000};               // plunge feed for holes, nm/min
  std::vector<DrillFeed> drill_feeds = {};    // of some drills
  Nanometres mill_feed{150'000'000};          // feed along circles and slots, nm/min
  std::optional<std::uint32_t> spindle = {};  // rpm; empty: no spindle commands
  DrawnPoint park = {};                       // park position, as in DrillOptions
  bool canned = true;                         // use G81 and G83; otherwise plain moves
  SafeChange change = {};
};

// Returns where the last target of the plan, which has one, ends.
DrawnPoint end_of_drilling(const DrillPlan& plan, const DrillProgramOptions& options);

// Returns the program text.
std::string write_drill_program(const DrillPlan& plan, const DrillProgramOptions& options);

}  // namespace passo
