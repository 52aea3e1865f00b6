// foam_skin: the surface of the foam that is left, as triangles: closed, each piece a body of its own.
//
// The surface goes through the places between cells where the distance from the melted edge is 0, and along the faces
// and the sides of the block.
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

// Hands out the triangles, always in the same order. `step`: one cell of so many in X and Y is looked at.
void foam_skin(const FoamBlock& foam, std::size_t step, const std::function<void(const SkinTriangle&)>& use);

}  // namespace passo
