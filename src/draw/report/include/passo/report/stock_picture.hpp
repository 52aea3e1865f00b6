// A picture of a piece of stock: from above with a scale, and as a body beside it. Light falls from the upper left.
//
// Colours tell the depth below the top. With a target they tell the difference from it: blue is material left, red is a
// gouge, grey is within the tolerance.
#pragma once

#include "passo/report/picture.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

struct StockDrawing {
  const HeightField& field;
  const HeightField* target = nullptr;  // of the same cells; null: there is none
  Mm tolerance{0.02};
};

// Draws into `file`, which the caller commits. options.program is the title, options.machine the words below it.
Status<OutputError> draw_stock(const StockDrawing& drawing, const PictureOptions& options, OutputFile& file);

}  // namespace passo
