// The seed of a random test, and the command that runs one case again.
//
// Without PASSO_SEED a test always draws the same cases, so that a run is repeatable and CI does not depend on chance.
// Longer runs set PASSO_SEED. PASSO_SEED_OFFSET is added to the seed of every test: `scripts/test.sh --full` draws one,
// so that each full run tries new cases. The seed is always printed, with the command that draws the same cases again.
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace passo::test {

// Returns a number from the environment, e.g. PASSO_RUNS, or `otherwise`.
inline std::uint64_t number_of(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

// Returns the first seed of a test that draws a case from each of many seeds.
inline std::uint64_t first_seed(std::uint64_t otherwise) {
  return number_of("PASSO_SEED", otherwise) + number_of("PASSO_SEED_OFFSET", 0);
}

// Returns the command that runs the current test again with this seed. `more`: further assignments, e.g. PASSO_RUNS=1.
inline std::string command_again(std::uint64_t seed, const std::string& more = "") {
  const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
  std::string command = "PASSO_SEED=" + std::to_string(seed) + (more.empty() ? "" : " " + more);
  command += std::string(" ") + program_invocation_name;
  if (test != nullptr) command += std::string(" --gtest_filter=") + test->test_suite_name() + "." + test->name();
  return command;
}

inline std::uint64_t seed() {
  const std::uint64_t value = first_seed(20261121);
  std::printf("%s\n", command_again(value).c_str());
  return value;
}

}  // namespace passo::test
