// arc_parts: splits an arc into what a controller accepts. Private to post_processor/.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "passo/post_processor/controller_words.hpp"

namespace passo {

// An arc in the plane of the axes `first` and `second` (0: X, 1: Y, 2: Z), in the order in which counterclockwise is
// positive. The third axis moves in proportion.
struct ProgrammedArc {
  std::size_t first = 0;
  std::size_t second = 1;
  std::array<double, 3> from = {};
  std::array<double, 3> to = {};
  std::array<double, 3> centre = {};  // the coordinate of the third axis is ignored
  bool counterclockwise = false;
};

struct ArcPart {
  std::array<double, 3> to = {};
  bool is_arc = false;  // otherwise a line
};

// `mm`: millimetres per unit of the arc. `digit`: the smallest difference between two written numbers, in the arc's
// unit. An arc that is flatter than half a digit becomes a line; one with a radius out of range becomes lines that are
// within 2 um of it.
std::vector<ArcPart> arc_parts(const ProgrammedArc& arc, const ArcLimits& limits, double mm, double digit);

}  // namespace passo
