// compare_foam: compares the foam that a hot wire has left with the target model: excess foam, and gouges into the
// model.
//
// The part consists of every piece of foam that lies mostly in the model or contains a hundredth of it. Each slice is
// compared with the model's section there, at the centres of its cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passo/stock/field_comparison.hpp"
#include "passo/stock/foam_block.hpp"

namespace passo {

using BodyTriangle = std::array<Vector3, 3>;

struct FoamDifference {
  enum class Cell : std::uint8_t { even, left, gouge, beside };  // beside: neither foam of the part nor model
  FieldDifference sides = {};
  std::vector<Cell> of = {};  // for each cell: slice by slice, row by row
};

// Deviations of at most `tolerance` from the model's surface are ignored.
FoamDifference compare_foam(const FoamBlock& foam, const FoamPieces& pieces, const std::vector<BodyTriangle>& body,
                            Mm tolerance);

}  // namespace passo
