// The surface of a relief: converts the levels of a picture, or a model seen from above, to a HeightGrid.
//
// The centres of the picture's outermost pixels lie on the edges of the relief. White is the top of the stock, Z 0;
// black lies `depth` below.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "passo/carve/height_grid.hpp"
#include "passo/carve/level_picture.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/surface.hpp"

namespace passo {

inline constexpr std::size_t most_fine_nodes = 20'000'000;

struct ReliefShape {
  std::optional<Mm> width = {};   // size in X; if `length` is empty, the aspect ratio is kept
  std::optional<Mm> length = {};  // size in Y
  std::optional<Mm> depth = {};   // depth of black; for a model its height. Empty: 3 mm, or the model's own height
  // The lowest height, as a distance below the top: heights are truncated there, not scaled.
  std::optional<Mm> lowest = {};
  double gamma = 1;  // height = level^gamma
  Mm smooth{0};      // for a picture: standard deviation of the Gaussian by which it is smoothed
  // For a picture: areas darker than this fraction of white stay at the top.
  double background = 0;
  bool invert = false;           // black is at the top
  bool mirror = false;           // swaps left and right, as for a stamp
  Mm margin{0};                  // width of a flat border
  bool margin_at_top = false;    // the border stays at the top; otherwise it is cut down to the depth
  std::optional<Mm> pitch = {};  // for a model: the sample distance; for a picture: the maximum distance of nodes, by
                                 // interpolation
  // The maximum spacing of the nodes if `pitch` is empty, unless that needs more than `most_fine_nodes` nodes. A model
  // gets at least 1,400 nodes along its longest side, but none closer than `finest_pitch`.
  std::optional<Mm> wished_pitch = {};
  Mm finest_pitch{0.01};
  unsigned threads = 1;  // for a model; the result does not depend on it
};

// A model, or a height map as triangles with a function for the height between their corners, which is exact along
// edges that are parallel to X or Y.
struct ReliefBody {
  std::vector<SurfaceTriangle> faces = {};
  std::function<double(double x, double y)> height = {};
};

// Returns the minimum height of the grid's nodes.
float floor_of(const HeightGrid& grid);

// Reports too many nodes and excessive depth as diagnostics "relief.…" with the file's `name`. The grid then has no
// columns.
HeightGrid relief_of(const LevelPicture& picture, const ReliefShape& shape, const std::string& name,
                     Diagnostics& diagnostics);

// Returns a surface of bilinear patches that lies nowhere below the model. On smooth faces it is higher than the model
// by the curvature within a cell; walls, and details smaller than a cell, are less than two cells wider. Positions
// outside the model get the height of its lowest point.
HeightGrid relief_of(ReliefBody body, const ReliefShape& shape, const std::string& name, Diagnostics& diagnostics);

}  // namespace passo
