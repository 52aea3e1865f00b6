// write_stock_body: writes a piece of stock as a closed solid in binary STL, millimetres.
//
// The surface passes through the centres of the cells, and is extended to the edges of the stock. Walls and a flat
// bottom close it: each edge belongs to exactly two triangles. Where the stock is cut through, surface and bottom are
// omitted. A cell has two triangles, or four if the stock is cut through anywhere, of 50 bytes each: 100 MB for a
// million cells. `step` reduces this: only every `step`-th cell in each direction is used. Between cells where a wall
// stands there are five times as many corners along each axis.
//
// Source: STL, 3D Systems, 1989.
#pragma once

#include <cstddef>
#include <cstdint>

#include "passo/report/output_file.hpp"
#include "passo/stock/height_field.hpp"
#include "passo/stock/wall_heights.hpp"

namespace passo {

// Returns the step with which at most a million cells are used.
std::size_t usual_body_step(const HeightField& field);

// Writes into `file`; the caller commits it. `walls`: those of the field with this step, or none. Returns the number of
// triangles.
std::uint64_t write_stock_body(const HeightField& field, std::size_t step, const WallHeights& walls, OutputFile& file);

}  // namespace passo
