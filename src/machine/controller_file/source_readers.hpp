// The readers of the formats that have a library.
#pragma once

#include <optional>

#include "passo/machine_import/machine_import.hpp"

namespace passo {

std::optional<SourceNode> read_yaml_tree(const ImportSource& source, Diagnostics& diagnostics);
std::optional<SourceNode> read_xml_tree(const ImportSource& source, Diagnostics& diagnostics);

// Adds an error at a place of the source.
void add_source_error(const ImportSource& source, Diagnostics& diagnostics, const char* code, std::uint32_t line,
                      std::uint32_t column, std::string message, std::string expected);

}  // namespace passo
