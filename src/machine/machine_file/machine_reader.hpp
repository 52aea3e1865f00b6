// Creates a MachineDescription from a parsed TOML file. Checks the keys, their ranges, and their consistency.
#pragma once

#include "toml_document.hpp"
#include "toml_reporter.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// The result is complete and valid only if no error was reported.
MachineDescription read_machine(const TomlDocument& document, const TomlReporter& reporter);

}  // namespace passo
