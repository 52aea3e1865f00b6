// ensure(): checks a condition that only a bug in Passo can make false. If it is false, the program ends at once, in
// Release builds too. A board on a link then executes its stop ramp and stops on the path, at a point that is in the
// journal: that is safer than unplanned motion.
//
// Conditions are checked in pairs: where a stage passes data on, and where the next stage receives it. Use ensure()
// only for checks that cost a comparison or two, and assert() for expensive ones. Chips do not use it: a board answers
// with an error.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace passo {

[[noreturn]] inline void end_by_bug(const char* file, int line) {
  std::fprintf(stderr, "passo: internal error, please report it: assertion failed at %s:%d\n", file, line);
  std::abort();
}

constexpr void ensure(bool holds, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (!holds) end_by_bug(file, line);
}

}  // namespace passo
