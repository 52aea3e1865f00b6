// write_levelled_program: a program as it is on a surface that is not flat, as a program of its own.
//
// The program is interpreted, and written again move by move: G0, G1, G2 and G3 in absolute work coordinates, with all
// that happens between the moves (tools, spindle, coolant, dwells, stops, messages). Loops, subprograms and cycles are
// written out. Each move follows the height map within a tolerance (levelling/levelled_move.hpp). The result stands for
// itself: it is checked, shown, run, broken off and resumed like any other program, here and on other machines.
//
// The map is in the work coordinates of the program: its height 0 is the program's Z0.
//
// What is not levelled:
// - rapids whose ends are both higher than the highest place of the map by `clear` at least: nothing is in their way;
// - what is drilled, unless `holes`: where the tool goes straight down and comes straight up again, its depths stay.
// (The
//   tool goes sideways only above the hole, so that begins and ends at the height of the surface.)
// - places of the machine: G53, G28 and G30 are written as such, and moves after them, or at the start, that do not
//   name Z do not get one. A feed there is a warning "level.height".
//
// Where the machine stands when the program starts is not known, nor which offsets and tool lengths it has. So words of
// work systems, tool lengths and homes stay words, and an axis is written as a place only where the program has named
// its place since. Any other axis goes as far as the program says (G91). A drilling cycle from an unknown height stays
// a cycle. Moves that nobody can place on the map are levelled where the options' start and offsets have them, with a
// warning "level.place".
//
// Refused, with a diagnostic "level.…" at the line: what a list of moves cannot say (probe moves, threads, taps,
// inputs, splines), words that move the zero of the work (G10 L2, G10 L20, G52, G92), and feeds farther beside the map
// than `beside`.
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
  double tolerance = 0.01;  // mm, of the height at each place of each move; above 0
  bool holes = false;       // what is drilled is levelled too
  double clear = 1;         // mm, see above
  double beside = 5;        // mm
  // The options' work offsets are those of the run: a change of the work system does not hide where the tool is.
  bool knows_offsets = false;
};

struct LevelCount {
  std::uint64_t moves_before = 0;
  std::uint64_t moves_after = 0;
  std::uint64_t holes = 0;  // whose depths stay
};

// Gives the text to `write`, piece by piece. Errors are in `diagnostics`; then the text is not whole.
LevelCount write_levelled_program(ProgramReader program, const InterpreterOptions& options, const HeightMap& map,
                                  const LevelOptions& wish, Diagnostics& diagnostics,
                                  const std::function<void(std::string_view)>& write);

}  // namespace passo
