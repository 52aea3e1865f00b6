// Draws a recorded path through a projection: rapids below, feeds above in the colours of their speed. Private to
// report/.
#pragma once

#include "projection.hpp"

#include "passo/report/path_recorder.hpp"

namespace passo {

Pen rapid_pen();
// A dense path gets a finer pen.
void draw_path(Canvas& canvas, const PathRecorder& path, const Projection& projection);

}  // namespace passo
