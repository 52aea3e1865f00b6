// edge_loops: the closed lines of a board's edge drawing, whatever pieces they are drawn in.
//
// Closed paths and circles are loops. Open paths are joined end to end: the two nearest free ends first, no two that
// are farther apart than `join`. What is drawn twice, or forth and back, counts once.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct EdgeLoops {
  std::vector<std::vector<PathPoint>> loops = {};  // the last point leads back to the first
  std::vector<std::vector<PathPoint>> open = {};   // rows of paths that do not close, where they are kept
  std::size_t joined = 0;                          // ends that did not meet, and were joined
  Nanometres widest_joined = {};
};

// What becomes of a row of paths that does not close: an error "outline.open" at each of its ends, or it is kept.
enum class OpenRows : std::uint8_t { refused, kept };

EdgeLoops edge_loops(const Drawing& drawing, Nanometres join, Diagnostics& diagnostics,
                     OpenRows open_rows = OpenRows::refused);

// The board inside the loops: a loop in another one is an opening, a loop in an opening is board again.
Region board_within(const EdgeLoops& loops);

// The same for any loops, of which very many may be drawn.
Region enclosed_by(const std::vector<std::vector<PathPoint>>& loops);

// The points of a path on chords within the tolerance; the last of a closed path is not the first.
DrawnRing chords_of_path(const std::vector<PathPoint>& points, bool is_closed, Nanometres tolerance);

}  // namespace passo
