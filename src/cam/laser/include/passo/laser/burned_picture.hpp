// draw_burned: draws what the beam burns, from the program itself.
//
// It reads the G-code that LaserProgram writes, follows each move, and distributes its energy, power times time, over a
// line as wide as the spot. So whatever the program does wrong is visible: a beam that is on between two cuts, a line
// that is shifted, a cell with the wrong power. The speed is taken as the feed; with M3 corners get more in reality.
// The darkness is in proportion to the energy per area; the darkest 2 % of what is burned are black.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "passo/cam/program_units.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct BurnedView {
  ProgramUnits units = ProgramUnits::mm;  // of the program
  Mm spot{0.1};                           // width of a line; at least 1.5 pixels are drawn
  std::size_t most_side = 900;            // pixels
};

// Returns a PNG file; empty if nothing is burned, or without memory.
std::string draw_burned(std::string_view program, const BurnedView& view);

}  // namespace passo
