// compare_fields: the material left above a target, and the gouges into it.
//
// A wall stands in one cell or in the next: no height field can say more. So what a cell has is compared with the
// highest and the lowest height of the target in the cell and its eight neighbours. Material left counts above the
// highest, a gouge below the lowest. On a slope this forgives a cell's width of the slope.
#pragma once

#include <cstddef>

#include "passo/stock/height_field.hpp"

namespace passo {

struct FieldDifference {
  struct Side {
    double volume = 0;      // mm³
    double largest = 0;     // mm
    Vector3 place{};        // of the largest, on the field
    std::size_t cells = 0;  // with more than the tolerance
  };
  Side left;
  Side gouge;
};

// Above 0: material left, mm. Below 0: a gouge. Both fields have the same cells.
double cell_difference(const HeightField& field, const HeightField& target, std::size_t column, std::size_t row);

// Differences up to the tolerance count for nothing.
FieldDifference compare_fields(const HeightField& field, const HeightField& target, Mm tolerance);

}  // namespace passo
