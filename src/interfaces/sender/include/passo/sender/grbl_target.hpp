// GrblTarget: what GrblCode must know about the board for which it writes lines.
#pragma once

#include "passo/geometry/axes.hpp"
#include "passo/sender/grbl_firmware.hpp"
#include "passo/sender/grbl_machine.hpp"

namespace passo {

struct GrblTarget {
  // A board with X, Y and Z. `work_zero`: in machine coordinates; the lines are relative to it.
  GrblTarget(const Point& work_zero = {}) : zero(work_zero) {}  // NOLINT: a zero alone means such a board
  // Returns the board as it describes itself, with the zero of G54 including G92.
  static GrblTarget of(const GrblMachine& machine);

  Point zero;  // mm and degrees
  AxisSet axes{7};
  GrblFirmware::FeedWay feed_way = GrblFirmware::FeedWay::all_axes;
  bool has_mist = true;  // M7
};

}  // namespace passo
