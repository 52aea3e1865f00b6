// import_controller_file: makes a machine file from a configuration file on disk. Its readers of YAML (yaml-cpp) and XML
// (expat) are for programs only; a browser has its own, and shares machine_import.
#pragma once

#include <optional>
#include <string>

#include "passo/machine_import/machine_import.hpp"

namespace passo {

// Reads a text into a tree. Returns nothing, and adds a diagnostic, if it has not this format or is too large.
std::optional<SourceNode> read_source_tree(ImportFormat format, const ImportSource& source, Diagnostics& diagnostics);

// The same as import_controller_file() for a text in memory.
std::optional<ImportedMachine> import_controller_text(const ImportSource& source, std::optional<ImportFormat> format,
                                                      Diagnostics& diagnostics);

// Without a format, it is detected from the content. Returns nothing, and adds diagnostics with codes "import.*", if the
// file cannot be read or does not describe a machine. The machine file has been read again, without an error.
std::optional<ImportedMachine> import_controller_file(const std::string& path, std::optional<ImportFormat> format,
                                                      Diagnostics& diagnostics);

}  // namespace passo
