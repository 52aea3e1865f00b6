// Splits texts of arbitrary bytes into characters. Private to report/.
#pragma once

#include <cstddef>
#include <string_view>

#include "passo/base/utf8.hpp"

namespace passo {

// Returns the number of bytes of the UTF-8 character at the start of `text`; 0 if there is none. A control character
// counts as none.
inline std::size_t character_length(std::string_view text) {
  const CodePoint first = first_code_point(text);
  return first.value < 0x20 || first.value == 0x7F ? 0 : first.length;
}

}  // namespace passo
