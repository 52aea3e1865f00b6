// Mirror: flips a board so that its back can be milled.
//
// `x` flips it left to right: X is mirrored about the line X = `at`. `y` flips it top to bottom, about the line Y =
// `at`.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct Mirror {
  enum class Turned : std::uint8_t { no, x, y };
  Turned turned = Turned::no;
  Nanometres at = {};
};

DrawnPoint mirrored(DrawnPoint point, const Mirror& mirror);
// Returns the mirrored region. The rings are reversed, so that they keep the region on their left.
Region mirrored(const Region& region, const Mirror& mirror);
void mirror_drawing(Drawing& drawing, const Mirror& mirror);

}  // namespace passo
