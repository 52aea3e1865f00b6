// A picture of a block of foam after the wire cut: both faces with scales, and the remaining foam as a 3D view.
//
// Each piece has a separate colour. With a target, excess foam is blue, and gouges are red. The 3D view shows the
// pieces that are cut free, i.e. that do not touch a side of the block in X or Y, if there are any.
#pragma once

#include "passo/report/picture.hpp"
#include "passo/stock/foam_block.hpp"
#include "passo/stock/foam_comparison.hpp"

namespace passo {

struct FoamDrawing {
  const FoamBlock& foam;
  const FoamPieces& pieces;
  const FoamDifference* difference = nullptr;  // null: no target
  bool has_two_faces = false;                  // the right face differs from the left one
};

// Draws into `file`; the caller commits it. options.program is the title, options.machine the line below it.
Status<OutputError> draw_foam(const FoamDrawing& drawing, const PictureOptions& options, OutputFile& file);

}  // namespace passo
