// The two views of a picture, with frames, ticks and the work zeros. Private to report/.
#pragma once

#include "projection.hpp"

#include "passo/report/path_recorder.hpp"

namespace passo {

// What is shown: the path's box, which is never flat, and the zero of its ticks.
struct Scene {
  explicit Scene(const PathRecorder& path);

  const PathRecorder& path;
  Box box;     // machine coordinates
  Point zero;  // zero of the ticks: the work zero if there is one, else the machine's
  bool work_coordinates = false;
};

void draw_top_view(Canvas& canvas, const Scene& scene, const Area& area);
void draw_isometric_view(Canvas& canvas, const Scene& scene, const Area& area);

}  // namespace passo
