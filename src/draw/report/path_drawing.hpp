// Draws a recorded path in a projection. Feed moves have the colours of their speed, depth or tool and are drawn over
// the rapids. Private to report/.
#pragma once

#include "path_colours.hpp"
#include "projection.hpp"

#include "passo/report/path_recorder.hpp"

namespace passo {

Pen rapid_pen();
// Draws the path, with a thinner pen if it is dense.
void draw_path(Canvas& canvas, const PathRecorder& path, const Projection& projection, const PathColours& colours,
               bool rapids);

}  // namespace passo
