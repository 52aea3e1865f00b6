// The YAML of a board with FluidNC: shown and replaced by `passo board settings`.
#pragma once

#include <string>

#include "commands.hpp"
#include "grbl_connection.hpp"

namespace passo {

// Returns whether a text can be a configuration of FluidNC. If not, it shows a message that names the file.
bool is_fluidnc_yaml(const std::string& path, const std::string& text);
// Prints the board's YAML. Returns the exit code.
int show_fluidnc_yaml(const BoardSettingsArguments& arguments, GrblConnection& opened);
// Replaces the file that the board reads at its start, and reads it back. Returns the exit code.
int write_fluidnc_yaml(const BoardSettingsArguments& arguments, GrblConnection& opened, std::string yaml);

}  // namespace passo
