// What a ramp table can do: `passo ramp --limit`, and the table itself: `passo ramp --print-table`.
#pragma once

#include "commands.hpp"

namespace passo {

// Both return an exit code. The numbers in the arguments are already checked.
int ramp_limit(const RampArguments& arguments);
int print_ramp_table(const RampArguments& arguments);

}  // namespace passo
