// The seed of a random test: PASSO_SEED, or the clock's; printed, so that a failure can be repeated.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>

namespace passo {

inline std::uint64_t random_seed() {
  const char* const given = std::getenv("PASSO_SEED");
  const std::uint64_t seed = given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device{}();
  std::cout << "PASSO_SEED=" << seed << '\n';
  return seed;
}

}  // namespace passo
