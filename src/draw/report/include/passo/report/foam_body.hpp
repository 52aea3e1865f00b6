// write_foam_body: the foam that a hot wire leaves, as closed bodies in binary STL, millimetres: one for each piece.
//
// X and Y are those of the wire's left end, Z goes along the wire from the left tower.
//
// Source: STL, 3D Systems, 1989.
#pragma once

#include <cstddef>
#include <cstdint>

#include "passo/report/output_file.hpp"
#include "passo/stock/foam_block.hpp"

namespace passo {

// The step that looks at ten million cells at most.
std::size_t usual_body_step(const FoamBlock& foam);

// Writes into `file`, which the caller commits. Returns the number of triangles. `step`: see foam_skin().
std::uint64_t write_foam_body(const FoamBlock& foam, std::size_t step, OutputFile& file);

}  // namespace passo
