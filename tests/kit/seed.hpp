// The seed of a random test. Without PASSO_SEED the seed is always the same, so that a run is repeatable and CI does
// not depend on chance. Longer runs set PASSO_SEED. The seed is always printed.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace passo::test {

// Returns a number from the environment, e.g. PASSO_RUNS, or `otherwise`.
inline std::uint64_t number_of(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

inline std::uint64_t seed() {
  const std::uint64_t value = number_of("PASSO_SEED", 20261121);
  std::printf("PASSO_SEED=%llu\n", static_cast<unsigned long long>(value));
  return value;
}

}  // namespace passo::test
