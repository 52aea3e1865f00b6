// nest_on_sheets: places copies of shapes on as few sheets as possible, at the left of the last one.
//
// A shape is the outside of its outlines: nothing is placed in the holes of another shape. Each copy goes to the
// corner of its free positions that a rule prefers, e.g. the leftmost one. Several orders and rules are tried, then
// the best order is changed a little, a bounded number of times. Only counts decide, so equal input gives equal output.
//
// Gaps and margins are kept within `nesting_tolerance`. Curves must come as chords within a few micrometres.
//
// Sources: L. J. Guibas, R. Seidel, Computing convolutions by reciprocal search (1987), for the no-fit polygons; A. M.
// Gomes, J. F. Oliveira, A 2-exchange heuristic for nesting problems (2002), for the search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/base/work_progress.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct NestShape {
  std::string name = {};                 // for messages
  std::vector<DrawnRing> outlines = {};  // closed, in any direction; at least one with an area
  std::uint32_t quantity = 1;
};

struct NestOptions {
  DrawnPoint sheet = {};        // the upper right corner; the lower left one is 0,0
  Nanometres gap = {};          // the least distance of two copies, and of a copy from an obstacle
  Nanometres margin = {};       // the least distance of a copy from the edge of the sheet
  std::uint32_t rotations = 4;  // of equal angles: 1 as drawn, 2 also half a turn (grain), 4 quarter turns, …
  std::vector<DrawnBox> obstacles = {};  // on each sheet, e.g. clamps
  std::uint32_t rounds = 200;            // layouts to try, at most; large nests try fewer
};

// Turn the shape about 0,0 by `degrees`, counterclockwise, then move it by `offset`.
struct NestPlacement {
  std::size_t shape = 0;  // an index
  double degrees = 0;
  DrawnPoint offset = {};
};

struct NestSheet {
  std::vector<NestPlacement> placements = {};  // from left to right
  Nanometres used = {};                        // X of the rightmost point; what is beyond is the offcut
};

struct Nest {
  std::vector<NestSheet> sheets = {};
  double parts_mm2 = 0;       // without the holes of shapes, which are not drawn here
  double sheets_mm2 = 0;      // of the sheets, the last one only as far as `used` and the margin
  std::uint32_t layouts = 0;  // number tried

  double density() const { return sheets_mm2 > 0 ? parts_mm2 / sheets_mm2 : 0; }
};

inline constexpr Nanometres nesting_tolerance{1'000};
inline constexpr std::uint32_t most_nested = 1000;  // copies of all shapes
inline constexpr std::uint32_t most_rotations = 72;
inline constexpr Nanometres largest_sheet{10'000'000'000};

// Why shapes cannot be nested, e.g. which of them is larger than the sheet, with sizes.
struct NestFailure {
  std::size_t shape = 0;
  std::string message = {};
};

Result<Nest, NestFailure> nest_on_sheets(const std::vector<NestShape>& shapes, const NestOptions& options,
                                         const WorkProgress& progress);

// Returns the point after the placement. Quarter turns are exact.
DrawnPoint placed(DrawnPoint point, const NestPlacement& placement);
DrawnRing placed(const DrawnRing& ring, const NestPlacement& placement);

}  // namespace passo
