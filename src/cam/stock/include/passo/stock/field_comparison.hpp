// compare_fields: computes the material left above a target, and the gouges into it.
//
// Material is left if the stock at the centre of a cell is higher than the highest point of the target in the cell and
// its eight neighbours. A gouge is a height below the lowest of these nine, or a cell that was certainly cut below the
// highest point of the target in it (CutTarget::at_most); at a wall, by more than a cell. At a wall, a difference
// counts sideways: its size is the distance to where the height is right, if that is less.
#pragma once

#include <cstddef>

#include "passo/stock/cut_target.hpp"
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
  // The largest gouge that the cells cannot show, mm: down into a face, and sideways into a wall.
  double unseen_depth = 0;
  double unseen_sideways = 0;
};

// Returns the material left (positive) or the depth of a gouge (negative), mm. All fields must have the same cells.
double cell_difference(const HeightField& field, const CutTarget& target, std::size_t column, std::size_t row);

// Differences up to the tolerance are ignored.
FieldDifference compare_fields(const HeightField& field, const CutTarget& target, Mm tolerance);

}  // namespace passo
