// require(): what a fuzzer holds to be true of every input. Ends the program where it is not, so that the fuzzer keeps
// the input.
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
