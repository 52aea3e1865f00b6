// The two views of a picture, with frames, ticks and the work zeros. Private to report/.
#pragma once

#include "path_colours.hpp"
#include "projection.hpp"

#include "passo/report/path_recorder.hpp"

namespace passo {

// The content of a view: the bounding box of the path, widened so that it is never flat, and the zero of the ticks.
struct Scene {
  Scene(const PathRecorder& path, const PictureOptions& options);

  const PathRecorder& path;
  PathColours colours;
  bool rapids;  // whether the rapids are drawn
  Box box;      // machine coordinates
  Point zero;   // zero of the ticks: the work zero if there is exactly one, otherwise machine zero
  bool work_coordinates = false;
};

// Draws a view along one axis of the machine. `view` must not be FlatView::automatic.
void draw_flat_view(Canvas& canvas, const Scene& scene, FlatView view, const Area& area);
// Returns the flat view that shows the most.
FlatView natural_view(const PathRecorder& path, bool is_lathe);
void draw_isometric_view(Canvas& canvas, const Scene& scene, const Area& area);

}  // namespace passo
