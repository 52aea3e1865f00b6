// compare_fields: computes the material left above a target, and the gouges into it.
//
// A wall is in one cell or in the next one: a height field cannot resolve it any better. Therefore a cell is compared
// with the highest and the lowest height of the target in the cell and its eight neighbours: remaining material counts
// above the highest, a gouge below the lowest. On a slope this tolerates an error of one cell width.
#pragma once

#include <cstddef>

#include "passo/stock/height_field.hpp"

namespace passo {

struct FieldDifference {
  struct Side {
    double volume = 0;      // mm³
    double largest = 0;     // mm
    Vector3 place{};        // position of the maximum, on the field
    std::size_t cells = 0;  // number of cells that exceed the tolerance
  };
  Side left;
  Side gouge;
};

// Returns the material left (positive) or the depth of a gouge (negative), mm. Both fields must have the same cells.
double cell_difference(const HeightField& field, const HeightField& target, std::size_t column, std::size_t row);

// Differences up to the tolerance are ignored.
FieldDifference compare_fields(const HeightField& field, const HeightField& target, Mm tolerance);

}  // namespace passo
