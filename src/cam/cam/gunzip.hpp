// gunzip: what a gzip file holds, as of drawings that end in .svgz. Private to cam/.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace passo {

inline bool looks_like_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1F\x8B");
}

// Several members are put together, as RFC 1952 has it. Nothing: the file is broken, or holds more than `most` bytes.
std::optional<std::string> gunzip(std::string_view bytes, std::size_t most);

}  // namespace passo
