// The number of trials of tests.
//
// PASSO_IN_FULL=N in the environment runs the tests that take minutes, with one in N of their trials. 1 means all
// trials. cmake/PassoModule.cmake defines PASSO_ONE_IN for all other tests: they run one in so many of their trials;
// with 0 each test decides.
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
    Test::SetUp();  // which may skip it, too
  }
};

// `usual`: the test's own decision.
constexpr int one_in(int usual = 1) {
  return PASSO_ONE_IN != 0 ? PASSO_ONE_IN : usual;
}
constexpr int fewer(int trials, int usual = 1) {
  return std::max(trials / one_in(usual), 1);
}

}  // namespace passo::test
