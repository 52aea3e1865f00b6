// Makes a MachineDescription of the tree of a TOML file. Checks the keys, their ranges, and how they fit together.
#pragma once

#include "toml_document.hpp"
#include "toml_reporter.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// The result is whole and sound only if nothing was reported.
MachineDescription read_machine(const TomlDocument& document, const TomlReporter& reporter);

}  // namespace passo
