// HandwheelDescription: [handwheel] of a machine file: a handwheel (manual pulse generator) at pins of the board.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/axes.hpp"

namespace passo {

struct HandwheelDescription {
  static constexpr std::size_t positions = 4;  // of its axis selector

  std::array<std::optional<Axis>, positions> axes = {};  // empty: this position moves nothing
  int counts_per_detent = 4;                             // edges of both lines
  double step = 0.01;  // of a detent at x1, mm or degrees; at x10 and x100 as many times more
  double share = 0.5;  // of the axis' highest speed
  bool is_reversed = false;
  SourceLocation place = {};  // of the table in the file
};

}  // namespace passo
