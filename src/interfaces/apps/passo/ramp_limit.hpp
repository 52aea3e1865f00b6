// The limits of a ramp table: `passo ramp --limit`, and the table itself: `passo ramp --print-table`.
#pragma once

#include "commands.hpp"

namespace passo {

// Both return an exit code. The numbers in the arguments must have been checked.
int ramp_limit(const RampArguments& arguments);
int print_ramp_table(const RampArguments& arguments);

}  // namespace passo
