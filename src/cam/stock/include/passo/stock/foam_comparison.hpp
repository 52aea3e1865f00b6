// compare_foam: what a hot wire has left beside a body that was wanted, and where it has melted into the body.
//
// What counts as the part is the foam that the body lies in: a piece most of which is in the body, or that holds a
// hundredth of it. Each slice is compared with the body's section there, at the middles of its cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passo/stock/field_comparison.hpp"
#include "passo/stock/foam_block.hpp"

namespace passo {

using BodyTriangle = std::array<Vector3, 3>;

struct FoamDifference {
  enum class Cell : std::uint8_t { even, left, gouge, beside };  // beside: neither foam of the part nor of the body
  FieldDifference sides = {};
  std::vector<Cell> of = {};  // of each cell: slice by slice, row by row
};

// Places that are at most `tolerance` from the body's surface count for nothing.
FoamDifference compare_foam(const FoamBlock& foam, const FoamPieces& pieces, const std::vector<BodyTriangle>& body,
                            Mm tolerance);

}  // namespace passo
