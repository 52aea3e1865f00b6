// A front view of a face: its position on the paper, with scales in millimetres. Private to report/.
#pragma once

#include "canvas.hpp"

namespace passo {

struct FaceExtent {
  double low_x = 0;
  double low_y = 0;
  double size_x = 0;
  double size_y = 0;
};

// Returns the largest area with the face's aspect ratio within `room`, at its upper left.
Area fitted(const FaceExtent& face, const Area& room);

// Draws the X scale below the area and the Y scale beside it.
void draw_scales(Canvas& canvas, const FaceExtent& face, const Area& area);

}  // namespace passo
