// plan_laser_lines: plans cuts along the lines of a drawing, in an order with short travels.
//
// Beside a line the beam stays half a kerf away from what is kept: outside the parts and inside their openings, by the
// nesting of the contours, as plan_profile() does for a cutter as wide as the kerf. On the lines, and for lines that
// are open, the beam follows what is drawn. Open lines come first, then contours, the innermost before those around
// them, so that a part is still held while its openings are cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "passo/cam/edge_loops.hpp"
#include "passo/cam/profile.hpp"
#include "passo/laser/laser_program.hpp"

namespace passo {

struct LaserLinesOptions {
  ProfileSide side = ProfileSide::part;
  Nanometres kerf{};      // width of the cut; 0: the beam follows the lines
  Nanometres lead{};      // radius of the lead-in arc from the scrap, only beside lines; 0: none
  DrawnPoint start = {};  // where the head comes from, and where it goes in the end
};

struct LaserLines {
  std::vector<std::vector<PathPoint>> paths = {};  // in order; a closed path ends at its first point
  std::size_t closed = 0;
  std::size_t open = 0;
  std::size_t dots = 0;  // left out: a beam at rest is off
};

// Reports errors and warnings "outline.…" and "profile.…" in `diagnostics`, e.g. an opening narrower than the kerf.
LaserLines plan_laser_lines(const EdgeLoops& lines, const LaserLinesOptions& options, Diagnostics& diagnostics);

struct LaserPasses {
  BeamSetting beam = {};
  std::uint32_t passes = 1;
  Nanometres step{};   // how much lower each pass is; 0: all have the same Z
  Nanometres focus{};  // Z of the first pass, only with a step
};

// Burns each path in all its passes before the next one: closed paths continue, open ones go there and back.
void burn_lines(LaserProgram& program, const LaserLines& lines, const LaserPasses& passes);

}  // namespace passo
