// The cost of a serial link to the board, as shown by `passo check`.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/judge/link_delay.hpp"

namespace passo {

// Runs link_delay() with a progress line. Empty if the cost cannot be computed. If the board refuses, shows a message.
std::optional<LinkDelay> line_cost_with_progress(const ProgramReader& program, const MachineDescription& machine,
                                                 const InterpreterOptions& options, const ProgramCheck& check,
                                                 Seconds without);

// Returns one line for the output of `passo check`, with a final newline.
std::string to_text(const LinkDelay& cost);
nlohmann::ordered_json as_json(const LinkDelay& cost);

}  // namespace passo
