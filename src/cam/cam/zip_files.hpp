// read_zip: extracts the files from a zip archive. Private to cam/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct NamedBytes {
  std::string name;
  std::string bytes;
};

inline constexpr std::size_t most_board_files = 1000;
inline constexpr std::size_t most_board_bytes = std::size_t{256} * 1024 * 1024;  // maximum total size, unpacked

bool looks_like_zip(std::string_view bytes);

// Reports an error "board.…" if the archive is corrupt, encrypted or too large.
std::vector<NamedBytes> read_zip(const std::string& path, Diagnostics& diagnostics);

}  // namespace passo
