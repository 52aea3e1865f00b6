// write_wire_program: the G-code of a wire cut.
//
// With four axes X Y move the left end of the wire, U V the right one, and each move has its own time (G93), so that
// the speeds are those of the plan. With two axes both ends move alike: the way is lines and arcs at one feed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/program_units.hpp"
#include "passo/cam/wire_cut.hpp"

namespace passo {

struct WireProgramOptions {
  std::string name = {};                  // of the program, for its first comment
  std::vector<std::string> files = {};    // of the drawings
  std::vector<std::string> remarks = {};  // a comment each
  ProgramUnits units = ProgramUnits::mm;
  bool has_four_axes = true;
  double feed = 200;                       // mm a minute, of two axes
  std::optional<std::uint32_t> heat = {};  // S of the wire's current; empty: the program leaves it alone
};

// The program's text. The plan has two places or more.
std::string write_wire_program(const WirePlan& plan, const WireProgramOptions& options);

}  // namespace passo
