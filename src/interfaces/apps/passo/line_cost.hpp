// What a line to the board costs, as `passo check` tells it.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/judge/line_cost.hpp"

namespace passo {

// line_cost() with a progress line. Empty: it cannot be told. A board that refuses comes as a message.
std::optional<LineCost> line_cost_with_progress(const ProgramReader& program, const MachineDescription& machine,
                                                const InterpreterOptions& options, const ProgramCheck& check,
                                                Seconds without);

// A line for the page of `passo check`, with a line end.
std::string to_text(const LineCost& cost);
nlohmann::ordered_json as_json(const LineCost& cost);

}  // namespace passo
