// read_bytes: reads a whole file that the user named, up to a maximum size.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct FileKind {
  std::string area;                                   // prefix of the error codes: "area.unreadable", "area.too-large"
  std::string expected;                               // "a DXF or drill file"
  std::size_t most = std::size_t{256} * 1024 * 1024;  // bytes
};

// Returns nothing, and adds a diagnostic, if the file cannot be read or is too large.
std::optional<std::string> read_bytes(const std::string& path, const FileKind& kind, Diagnostics& diagnostics);

// Returns a finding about the file as a whole.
Diagnostic of_file(std::string code, const std::string& path, std::string message, std::string expected);

}  // namespace passo
