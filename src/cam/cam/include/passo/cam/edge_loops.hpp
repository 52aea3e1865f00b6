// edge_loops: joins the pieces of a board's edge drawing to closed loops.
//
// Closed paths and circles are loops. Open paths are joined end to end, the nearest free ends first, if they are at
// most `join` apart. Duplicate pieces and duplicate loops, including those drawn in the opposite direction, count once.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct EdgeLoops {
  std::vector<std::vector<PathPoint>> loops = {};  // the last point leads back to the first
  std::vector<std::vector<PathPoint>> open = {};   // open contours, if they are kept
  std::size_t joined = 0;                          // number of gaps that were bridged
  Nanometres widest_joined = {};
  std::size_t repeated = 0;  // number of loops that repeat another one, within 0.001 mm
};

// The treatment of open contours: an error "outline.open" that names the ends (an error for each if two lines of the
// file have drawn them), or keeping them. `slots`: a line within the board whose ends are more than 1 mm from other
// ends is kept, other open contours are refused.
enum class OpenRows : std::uint8_t { refused, kept, slots };

EdgeLoops edge_loops(const Drawing& drawing, Nanometres join, Diagnostics& diagnostics,
                     OpenRows open_rows = OpenRows::refused);

// Returns the board inside the loops: a loop within a loop is a cutout, a loop within a cutout is board again.
Region board_within(const EdgeLoops& loops);

// Does the same for arbitrary loops, of which there may be very many.
Region enclosed_by(const std::vector<std::vector<PathPoint>>& loops);

// Returns the path as chords within the tolerance. A closed path does not repeat its first point.
DrawnRing chords_of_path(const std::vector<PathPoint>& points, bool is_closed, Nanometres tolerance);

}  // namespace passo
