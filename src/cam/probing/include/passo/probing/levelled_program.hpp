// write_levelled_program: applies a height map to a program (auto-levelling) and writes the result as a new program.
//
// The program is interpreted and rewritten move by move: G0, G1, G2 and G3 in absolute work coordinates, together with
// everything between the moves (tools, spindle, coolant, dwells, stops, messages). Loops, subroutines and cycles are
// expanded. Each move follows the height map within a tolerance (levelling/levelled_move.hpp). The result is a
// self-contained program: it can be checked, shown, run, interrupted and resumed like any other program, on other
// controllers, too.
//
// The map is in the work coordinates of the program: its height 0 is the program's Z0.
//
// The following moves are not levelled:
// - rapids whose ends are both at least `clear` above the highest point of the map, where no obstacle is possible;
// - drilling, unless `holes` is set: where the tool moves straight down and straight up again, Z below the top of the
//   hole stays as programmed; above the hole, where the tool moves sideways, it follows the surface;
// - moves in machine coordinates: G53, G28 and G30 are written as such. Moves after them, or at the start, that do not
//   specify Z do not get a Z. A feed move there causes a warning "level.height".
//
// The machine's position at the start of the program, its offsets and its tool lengths are unknown. Therefore changes
// of work coordinate systems and tool lengths, and homing commands, are copied, and an axis is written with an absolute
// position only if the program has specified its position since. Any other axis moves by the programmed distance (G91).
// A drilling cycle from an unknown height stays a cycle. Moves whose position on the map is unknown are levelled
// according to the start and the offsets in the options, with a warning "level.place".
//
// The following are refused with a diagnostic "level.…" at the line: operations that a list of moves cannot express
// (probe moves, threads, taps, inputs, splines), codes that shift the work zero (G10 L2, G10 L20, G52, G92), and feed
// moves farther outside the map than `beside`.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/levelling/height_map.hpp"

namespace passo {

struct LevelOptions {
  double tolerance = 0.01;  // mm, maximum height error at each point of each move; above 0
  bool holes = false;       // levels drilling, too
  double clear = 1;         // mm, clearance of unlevelled rapids, see above
  double beside = 5;        // mm, maximum distance of feed moves outside the map
  // The options' work offsets are those of the run, so the position stays known after a change of the work coordinate
  // system.
  bool knows_offsets = false;
};

struct LevelCount {
  std::uint64_t moves_before = 0;
  std::uint64_t moves_after = 0;
  std::uint64_t holes = 0;  // number of holes that keep their depths
};

// Passes the text to `write`, piece by piece. Reports errors in `diagnostics`; the text is then incomplete.
LevelCount write_levelled_program(ProgramReader program, const InterpreterOptions& options, const HeightMap& map,
                                  const LevelOptions& wish, Diagnostics& diagnostics,
                                  const std::function<void(std::string_view)>& write);

}  // namespace passo
