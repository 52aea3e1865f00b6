// From the tree of a TOML file to a MachineDescription: the keys, their ranges, and what they must be to each other.
#pragma once

#include "toml_document.hpp"
#include "toml_reporter.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Whole and sound only where nothing was reported.
MachineDescription read_machine(const TomlDocument& document, const TomlReporter& reporter);

}  // namespace passo
