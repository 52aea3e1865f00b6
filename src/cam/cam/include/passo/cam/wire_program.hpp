// write_wire_program: writes a wire cut as G-code.
//
// With four axes, X Y move the left end of the wire and U V the right one; each move has its own duration (G93), which
// gives the planned speeds. With two axes both ends move alike: the program consists of lines and arcs at one feed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/program_units.hpp"
#include "passo/cam/wire_cut.hpp"

namespace passo {

struct WireProgramOptions {
  std::string name = {};                  // program name, for the first comment
  std::vector<std::string> files = {};    // names of the drawing files
  std::vector<std::string> remarks = {};  // comments at the head of the program
  ProgramUnits units = ProgramUnits::mm;
  bool has_four_axes = true;
  double feed = 200;                       // feed with two axes, mm/min
  std::optional<std::uint32_t> heat = {};  // S word for the wire current; empty: no heating commands
};

// Returns the program text. The plan must have at least two points.
std::string write_wire_program(const WirePlan& plan, const WireProgramOptions& options);

}  // namespace passo
