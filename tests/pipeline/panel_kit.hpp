// What the tests of buttons have in common: a program of even motion, and the time when the motion gets slower.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kit/step_log.hpp"

namespace passo::test {

// 15 seconds of even motion along X.
inline const std::string along = "G21 G90 G1 F2400\nX300\nX0\nM2\n";

// How long after `pressed`, in seconds, a step first comes three intervals later than in the even motion before.
// Negative: never.
inline double reaction(const std::vector<StepLog::Step>& steps, double clock, double pressed) {
  const auto time = [&](std::size_t i) { return static_cast<double>(steps[i].tick) / clock; };
  std::size_t last = 0;
  while (last + 1 < steps.size() && time(last + 1) <= pressed) ++last;
  constexpr std::size_t measured = 500;
  if (last < measured) return -1;
  const double interval = (time(last) - time(last - measured)) / measured;
  for (std::size_t i = last + 1; i < steps.size(); ++i) {
    const double even = time(last) + static_cast<double>(i - last) * interval;
    if (time(i) > even + 3 * interval) return time(i) - pressed;
  }
  return -1;
}

}  // namespace passo::test
