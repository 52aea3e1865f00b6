// A face seen straight on: its place on the paper, and scales in millimetres beside it. Private to report/.
#pragma once

#include "canvas.hpp"

namespace passo {

struct FaceExtent {
  double low_x = 0;
  double low_y = 0;
  double size_x = 0;
  double size_y = 0;
};

// The largest area of the face's shape within `room`, at its upper left.
Area fitted(const FaceExtent& face, const Area& room);

// Scales of X below the area and of Y beside it.
void draw_scales(Canvas& canvas, const FaceExtent& face, const Area& area);

}  // namespace passo
