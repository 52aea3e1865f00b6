// BoardKind: which emulated board a test is about, with the firmware of this build.
#pragma once

#include <cstdint>
#include <string>

#include "passo/emulator/emulated_board.hpp"

namespace passo::test {

struct BoardKind {
  const char* name;
  const char* program;
  std::int64_t cycles_of_tick = 1;  // of the clock by which the host counts
};

inline constexpr BoardKind uno{"uno", PASSO_MOTION_UNO};
inline constexpr BoardKind mega{"mega", PASSO_MOTION_MEGA};
inline constexpr BoardKind pico{"pico", PASSO_MOTION_PICO, 8};
inline constexpr BoardKind pico_lathe{"pico_lathe", PASSO_MOTION_PICO_LATHE, 8};

// Why there is no such board here: the Pico's compiler or its emulator is not installed. Empty: there is one.
inline std::string missing(const BoardKind& kind) {
  if (kind.program[0] == '\0') return "no firmware was built for it";
  const auto board = EmulatedBoard::start(kind.name, kind.program);
  return board ? std::string() : board.error();
}

}  // namespace passo::test
