// A picture of a block of foam after the wire: both faces with scales, and what is left as a body.
//
// Each piece has a colour of its own. With a target, blue is foam left beside it, red is melted out of it. The body
// shows what the wire has cut free: the pieces that reach no side of the block in X or Y, where there are such.
#pragma once

#include "passo/report/picture.hpp"
#include "passo/stock/foam_block.hpp"
#include "passo/stock/foam_comparison.hpp"

namespace passo {

struct FoamDrawing {
  const FoamBlock& foam;
  const FoamPieces& pieces;
  const FoamDifference* difference = nullptr;  // null: there is no target
  bool has_two_faces = false;                  // of which the right one differs from the left one
};

// Draws into `file`, which the caller commits. options.program is the title, options.machine the words below it.
Status<OutputError> draw_foam(const FoamDrawing& drawing, const PictureOptions& options, OutputFile& file);

}  // namespace passo
