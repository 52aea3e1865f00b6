// foam_skin: generates the surface of the remaining foam as triangles: closed, each piece a separate solid.
//
// The surface passes through the points between cells where the distance from the melted edge is 0, and along the faces
// and sides of the block.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "passo/stock/foam_block.hpp"

namespace passo {

struct SkinTriangle {
  std::array<Vector3, 3> corners = {};  // counterclockwise, seen from outside
  std::size_t column = 0;               // a cell of the foam below it
  std::size_t row = 0;
  std::size_t slice = 0;
};

// Passes the triangles to `use`, always in the same order. `step`: only every `step`-th cell in X and Y is evaluated.
void foam_skin(const FoamBlock& foam, std::size_t step, const std::function<void(const SkinTriangle&)>& use);

}  // namespace passo
