// The seed of a random test: PASSO_SEED, or always the same, so that a run can be repeated and CI does not depend on
// luck. The seed is always printed. Longer runs set PASSO_SEED from outside.
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

}  // namespace passo::test
