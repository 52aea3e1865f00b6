// What a drilling cycle (G73, G74, G81 … G89) remembers: from block to block, and from hole to hole of one block.
//
// "Depth" and "height" are along the axis through the active plane. Millimetres.
#pragma once

#include <cstdint>

#include "code_table.hpp"

#include "passo/interpreter/operation.hpp"

namespace passo {

// Words that hold until another motion code, and with them R, the depth and P or Q of the blocks that leave them out.
struct DrillingWords {
  CodeNumber code = 0;  // 0: no cycle is active
  Plane plane = Plane::xy;
  bool complete = false;  // false: its first block was wrong, and what follows is not drilled
  double initial_height = 0;
  double retract = 0;  // R as written
  double depth = 0;    // the depth axis' word as written
  double dwell = 0;
  double peck = 0;
  Point aside;  // G87: how far the tool goes aside, in the plane; through it the top of the back bore as written
};

// One block's holes.
struct DrillingCycle {
  CodeNumber code = 0;
  Axis axis = Axis::z;
  std::int32_t holes_left = 0;
  bool in_hole = false;
  double retract = 0;  // the height of R
  double bottom = 0;
  double top = 0;      // of a back bore
  double height = 0;   // to the next hole
  double clear = 0;    // out of a hole
  double reached = 0;  // by the pecks so far
};

}  // namespace passo
