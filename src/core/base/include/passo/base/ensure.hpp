// ensure(): a condition that only a bug of ours makes false. Then the program ends at once, in Release builds too. A
// board at the end of a line plays its tail and comes to rest on the path, and the journal knows where: that is safer
// than motion that nobody has planned.
//
// Conditions stand in pairs: where a stage hands something on, and where the next one takes it. Only for what costs a
// comparison or two; what costs more is an assert. On chips there is none of this: a board answers with an error.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace passo {

[[noreturn]] inline void end_by_bug(const char* file, int line) {
  std::fprintf(stderr, "passo: this is a bug: %s:%d found what cannot be\n", file, line);
  std::abort();
}

constexpr void ensure(bool holds, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (!holds) end_by_bug(file, line);
}

}  // namespace passo
