// read_bytes: the whole of a file that a user named, up to a size.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct FileKind {
  std::string area;                                   // of the codes: "area.unreadable", "area.too-large"
  std::string expected;                               // "a DXF or drill file"
  std::size_t most = std::size_t{256} * 1024 * 1024;  // bytes
};

// Nothing, with a diagnostic, if the file cannot be read or has more bytes.
std::optional<std::string> read_bytes(const std::string& path, const FileKind& kind, Diagnostics& diagnostics);

// A finding about the file as a whole.
Diagnostic of_file(std::string code, const std::string& path, std::string message, std::string expected);

}  // namespace passo
