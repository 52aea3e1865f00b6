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

  // Returns the way to which F applies in a straight move, mm and degrees; in inverse time it does not matter.
  double way(const Point& step) const;

  Point zero;  // mm and degrees
  AxisSet axes{7};
  GrblFirmware::FeedWay feed_way = GrblFirmware::FeedWay::all_axes;
  bool has_mist = true;  // M7
  bool measures_motors =
      false;  // a CoreXY whose F applies to the motors: of a move of X and Y, the way is sqrt(2) longer
};

}  // namespace passo
