// Creates a MachineDescription from a parsed TOML file. Checks the keys, their ranges, and their consistency.
#pragma once

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/toml_document.hpp"
#include "passo/toml/toml_reporter.hpp"

namespace passo {

// The result is complete and valid only if no error was reported.
MachineDescription read_machine(const TomlDocument& document, const TomlReporter& reporter, MachineUse use);

}  // namespace passo
