// write_foam_body: writes the foam that a hot wire leaves as closed solids in binary STL, millimetres: one per piece.
//
// X and Y are those of the wire's left end; Z runs along the wire from the left tower.
//
// Source: STL, 3D Systems, 1989.
#pragma once

#include <cstddef>
#include <cstdint>

#include "passo/report/output_file.hpp"
#include "passo/stock/foam_block.hpp"

namespace passo {

// Returns the step with which at most ten million cells are evaluated.
std::size_t usual_body_step(const FoamBlock& foam);

// Writes into `file`; the caller commits it. Returns the number of triangles. `step`: see foam_skin().
std::uint64_t write_foam_body(const FoamBlock& foam, std::size_t step, OutputFile& file);

}  // namespace passo
