// lower_case: converts the ASCII letters of a text to lower case, in any locale.
#pragma once

#include <algorithm>
#include <string>

namespace passo {

inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace passo
