// The surface of a relief: from a picture's levels, or from a body seen from above, to a HeightGrid.
//
// The middles of the picture's outermost pixels lie on the edges of the relief. White is the top of the stock, Z 0;
// black lies `depth` below.
#pragma once

#include <optional>
#include <string>

#include "passo/carve/height_grid.hpp"
#include "passo/carve/level_picture.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/surface.hpp"

namespace passo {

inline constexpr std::size_t most_fine_nodes = 20'000'000;

struct ReliefShape {
  std::optional<Mm> width = {};   // in X; with `length` empty, the other side follows
  std::optional<Mm> length = {};  // in Y
  std::optional<Mm> depth = {};   // of black; of a body: its height. Empty: 3 mm, or as the body is
  double gamma = 1;               // height = level^gamma
  bool invert = false;            // black is the top
  bool mirror = false;            // left becomes right, as for a stamp
  Mm margin{0};                   // width of a flat rim around it
  bool margin_at_top = false;     // the rim stays at the top; else it is cut down to the depth
  std::optional<Mm> pitch = {};   // of a body: the distance of its samples; of a picture: at most this, by finer nodes
  // Where `pitch` is empty, a picture's nodes become so fine, as far as `most_fine_nodes` allow.
  std::optional<Mm> wished_pitch = {};
};

// The height of the lowest node that a surface may have.
float floor_of(const HeightGrid& grid);

// Too many nodes and too deep a body are diagnostics "relief.…" with the file's `name`. The grid then has no columns.
HeightGrid relief_of(const LevelPicture& picture, const ReliefShape& shape, const std::string& name,
                     Diagnostics& diagnostics);

// The heights of the body at the nodes; between nodes the bilinear patches are what is carved. Where there is no body
// it is as deep as the body's lowest point.
HeightGrid relief_of(const Surface& body, const ReliefShape& shape, const std::string& name, Diagnostics& diagnostics);

}  // namespace passo
