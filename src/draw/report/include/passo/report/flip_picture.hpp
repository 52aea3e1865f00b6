// A picture of a board that is flipped about its dowel holes: the front before, the back after, the axis, and the
// position of each hole.
#pragma once

#include <array>

#include "passo/cam/mirror.hpp"
#include "passo/cam/region.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

// All coordinates are those of the program, as seen from the front.
struct FlipScene {
  const Region& face;   // the board; may be empty
  const Region& front;  // the copper
  const Region& back;
  std::array<DrawnPoint, 2> holes = {};  // hole 1 and hole 2
  Nanometres diameter = {};
  Mirror mirror = {};
};

// Draws into `file`; the caller commits it.
Status<OutputError> draw_flip(const FlipScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
