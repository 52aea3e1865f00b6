// require(): checks an invariant for every input of a fuzzer. If it does not hold, require() terminates the program, so
// that the fuzzer keeps the input.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace passo::test {

inline void require(bool condition, const char* what, std::string_view text = "") {
  if (condition) return;
  std::fprintf(stderr, "%s%s%.*s\n", what, text.empty() ? "" : ": ", static_cast<int>(text.size()), text.data());
  std::abort();
}

}  // namespace passo::test
