// Reads [hooks]: lines of G-code that run at the start and at the end of each job.
#pragma once

#include <functional>

#include "passo/interpreter/program_hooks.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// `finish` is called with the table's reader at the end.
ProgramHooks read_hooks(const TomlEntry& entry, const TomlReporter& reporter,
                        const std::function<void(TableReader&)>& finish);

}  // namespace passo
