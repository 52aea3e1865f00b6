// Reads [hooks]: lines of G-code that run at the start and at the end of each job.
#pragma once

#include "passo/interpreter/program_hooks.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

ProgramHooks read_hooks(TableReader& reader, const TomlTable& table);

}  // namespace passo
