// How many of their trials tests make.
//
// PASSO_IN_FULL=N: tests that take minutes are run, with one in N of their trials; 1: with all of them.
// PASSO_ONE_IN, a definition of the test program (cmake/PassoModule.cmake): the other tests make one in so many.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

namespace passo::test {

// 0: they are not run.
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
