// counted: a number and its noun, as messages and programs say it: "1 hole", "2 holes".
#pragma once

#include <cstddef>
#include <string>

namespace passo {

inline std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace passo
