// The toolpath of a program in the machine, move by move, and the check that a levelled program has the same toolpath,
// raised by the map. For tests.
#pragma once

#include <string>
#include <vector>

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/frame_blocks.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/levelling/height_map.hpp"

namespace passo::test {

struct PathMove {
  std::uint32_t line = 0;
  bool rapid = false;
  bool of_machine = false;      // in machine coordinates: G53, and the second move of G28 and G30
  bool to_stored_home = false;  // moves to a home position that the program has stored itself (G28.1), with the digits
                                // of its moves
  bool incremental = false;
  bool in_cycle = false;
  bool changes_frame = false;  // no move: the work frame or the tool length has changed
  bool changes_height_only = false;
  AxisSet named = {};
  Point from = {};  // machine coordinates
  Point to = {};
  Frame frame = {};
  bool is_arc = false;
  Plane plane = Plane::xy;
  double first_center = 0;  // work coordinates
  double second_center = 0;
  double sweep = 0;

  bool moves() const;
  // Work coordinates.
  Point start() const { return frame.work_from_machine(from); }
  Point end() const { return frame.work_from_machine(to); }
  bool moves_sideways() const;
  // Returns the machine position at a fraction of the move.
  Point at(double part) const;
};

struct RunPath {
  std::vector<PathMove> moves;
  std::string findings;
};

RunPath path_of(const std::string& program, const InterpreterOptions& options);

struct PathWish {
  double tolerance = 0.01;
  double clear = 1;
  // The leveller knew the machine's start position and all offsets.
  bool all_known = false;
};
// Returns the first difference of the paths; empty if they agree. `levelled` was levelled with its holes.
std::string difference_of(const RunPath& program, const RunPath& levelled, const HeightMap& map, const PathWish& wish);

}  // namespace passo::test
