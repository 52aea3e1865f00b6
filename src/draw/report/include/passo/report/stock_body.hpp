// write_stock_body: a piece of stock as a closed body in binary STL, millimetres.
//
// The face goes through the middles of the cells, and straight on to the edges of the stock. Walls and a flat bottom
// close it: each edge belongs to exactly two triangles. Where the stock is cut through, face and bottom are left out.
// A cell has two triangles, four if the stock is cut through anywhere, of 50 bytes each: 100 MB for a million cells. So
// `step` may take one cell of so many in each direction.
//
// Source: STL, 3D Systems, 1989.
#pragma once

#include <cstddef>
#include <cstdint>

#include "passo/report/output_file.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

// The step that gives a million cells at most.
std::size_t usual_body_step(const HeightField& field);

// Writes into `file`, which the caller commits. Returns the number of triangles.
std::uint64_t write_stock_body(const HeightField& field, std::size_t step, OutputFile& file);

}  // namespace passo
