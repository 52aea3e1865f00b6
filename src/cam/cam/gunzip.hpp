// gunzip: decompresses gzip data, e.g. drawings that end in .svgz. Private to cam/.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace passo {

inline bool looks_like_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1F\x8B");
}

// Concatenates several members, as RFC 1952 specifies. Returns nothing if the data is corrupt or expands to more than
// `most` bytes.
std::optional<std::string> gunzip(std::string_view bytes, std::size_t most);

}  // namespace passo
