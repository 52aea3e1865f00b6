// SubprogramJump: M98 or M99, whose words are the block's (BlockExecutor) and whose way is the program's (ProgramFlow).
#pragma once

#include <cstdint>

#include "passo/gcode/block.hpp"

namespace passo {

struct SubprogramJump {
  bool call = false;  // M98; else M99
  bool good = true;   // false: where to cannot be told
  std::int32_t program = 0;
  std::int32_t passes = 1;
  Span span;
};

}  // namespace passo
