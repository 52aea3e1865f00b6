// The seed of a random test. Without PASSO_SEED the seed is always the same, so that a run can be repeated and CI does
// not depend on luck. Longer runs set PASSO_SEED from outside. The seed is always printed.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace passo::test {

inline std::uint64_t seed() {
  const char* const given = std::getenv("PASSO_SEED");
  const std::uint64_t value = given != nullptr ? std::strtoull(given, nullptr, 10) : 20261121;
  std::printf("PASSO_SEED=%llu\n", static_cast<unsigned long long>(value));
  return value;
}

// How many trials a random test makes: PASSO_RUNS, or as many as a developer waits for.
inline int trials(int usual) {
  const char* const given = std::getenv("PASSO_RUNS");
  return given != nullptr ? std::atoi(given) : usual;
}

}  // namespace passo::test
