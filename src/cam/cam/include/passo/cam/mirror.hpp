// Mirror: a board that is turned over, so that its back is milled.
//
// `x` turns it over from left to right: X changes its sign about the line X = `at`. `y` turns it over from top to
// bottom, about the line Y = `at`.
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
// Rings keep the region to their left.
Region mirrored(const Region& region, const Mirror& mirror);
void mirror_drawing(Drawing& drawing, const Mirror& mirror);

}  // namespace passo
