// Evaluating an expression of the block at hand, with its errors reported.
#pragma once

#include "parameters.hpp"
#include "reporter.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

[[nodiscard]] bool evaluate(const Block& block, const Expression& expression, const Parameters& parameters,
                            const Reporter& reporter, double& value);

}  // namespace passo
