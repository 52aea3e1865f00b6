// A picture of a piece of stock: a top view with a scale, and a 3D view, lit from the upper left.
//
// Colours show the depth below the top. With a target they show the deviation: blue is excess material, red is a gouge,
// grey is within the tolerance.
#pragma once

#include "passo/report/picture.hpp"
#include "passo/stock/cut_target.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

struct StockDrawing {
  const HeightField& field;
  const CutTarget* target = nullptr;  // with the same cells; null: no target
  Mm tolerance{0.02};
};

// Draws into `file`; the caller commits it. options.program is the title, options.machine the line below it.
Status<OutputError> draw_stock(const StockDrawing& drawing, const PictureOptions& options, OutputFile& file);

}  // namespace passo
