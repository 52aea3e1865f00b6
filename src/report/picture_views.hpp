// The two views of a picture, with frames, ticks and the work zeros. Private to report/.
#pragma once

#include "projection.hpp"

#include "passo/report/path_recorder.hpp"

namespace passo {

// What a view shows: the box of the path, which is widened so that it is never flat, and the zero of the ticks.
struct Scene {
  explicit Scene(const PathRecorder& path);

  const PathRecorder& path;
  Box box;     // machine coordinates
  Point zero;  // zero of the ticks: the work zero if there is exactly one, else machine zero
  bool work_coordinates = false;
};

void draw_top_view(Canvas& canvas, const Scene& scene, const Area& area);
void draw_isometric_view(Canvas& canvas, const Scene& scene, const Area& area);

}  // namespace passo
