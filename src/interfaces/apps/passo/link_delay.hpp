// The cost of a serial link to the board, with a progress line.
#pragma once

#include <optional>

#include "passo/judge/link_delay.hpp"

namespace passo {

// Runs link_delay() with a progress line. Empty if the cost cannot be computed. If the board refuses, shows a message.
std::optional<LinkDelay> line_cost_with_progress(const ProgramReader& program, const MachineDescription& machine,
                                                 const InterpreterOptions& options, const ProgramCheck& check,
                                                 Seconds without);

}  // namespace passo
