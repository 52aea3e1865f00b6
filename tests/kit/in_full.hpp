// The number of trials of tests.
//
// PASSO_IN_FULL=N in the environment runs the tests that take minutes, with one in N of their trials. 1 means all
// trials. cmake/PassoModule.cmake defines PASSO_ONE_IN: all other tests run one in PASSO_ONE_IN of their trials.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

namespace passo::test {

// Returns PASSO_IN_FULL. 0: tests that take minutes are skipped.
inline std::uint64_t in_full() {
  const char* const text = std::getenv("PASSO_IN_FULL");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
}

template <class Test>
class InFull : public Test {
 protected:
  void SetUp() override {
    if (in_full() == 0) GTEST_SKIP() << "takes minutes: PASSO_IN_FULL=1";
  }
};

inline constexpr int one_in = PASSO_ONE_IN;
constexpr int fewer(int trials) {
  return std::max(trials / one_in, 1);
}

}  // namespace passo::test
