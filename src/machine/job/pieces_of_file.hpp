#pragma once

#include <array>
#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>

namespace passo {

// Passes the file to `take`, in pieces, until `take` returns false. Returns false if the file cannot be read.
template <typename Take>
bool read_pieces(const std::string& path, const Take& take) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  std::array<char, 1 << 16> piece;
  do {
    file.read(piece.data(), piece.size());
  } while (take(std::string_view(piece.data(), static_cast<std::size_t>(file.gcount()))) && file);
  return !file.bad();
}

}  // namespace passo
