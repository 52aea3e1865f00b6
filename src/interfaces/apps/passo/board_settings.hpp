// The settings of a Grbl board, read by a command.
#pragma once

#include <optional>
#include <string>

namespace passo {

// Connects to a Grbl board, and returns what it says of its configuration, in a form that import_controller_text()
// understands: its settings, or FluidNC's YAML. Empty, with a message and `code`, on failure.
std::optional<std::string> controller_text_of(const std::string& board, int& code);

}  // namespace passo
