// lower_case: a text with its letters of ASCII in lower case, whatever the locale.
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
