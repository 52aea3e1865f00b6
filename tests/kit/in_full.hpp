// PASSO_IN_FULL=N: tests that take minutes are run, with one in N of their trials; 1: with all of them.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace passo::test {

// 0: they are not run.
inline std::uint64_t in_full() {
  const char* const text = std::getenv("PASSO_IN_FULL");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
}

}  // namespace passo::test
