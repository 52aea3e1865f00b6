// A tool change that moves by itself: M6 on a machine whose file has [tool_change]. Its height and its places are
// machine coordinates, so it needs a position that is known by homing, or that a person has confirmed.
#pragma once

#include <cstdint>
#include <string>

#include "passo/base/sentence.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

bool is_placed_tool_change(const Operation& operation, const MachineDescription& machine);

// Why M6 is refused where the position is not known.
Sentence sentence_of_unplaced_tool_change();
Diagnostic unplaced_tool_change(const std::string& file, std::uint32_t line);

}  // namespace passo
