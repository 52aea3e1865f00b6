// SubprogramJump: M98, M99, a macro call, or a user code with a subroutine. BlockExecutor reads its words from the
// block, and ProgramFlow executes the jump.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "parameters.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

struct SubprogramJump {
  enum class Kind : std::uint8_t {
    leave,        // M99
    call,         // M98
    macro,        // G65
    modal_macro,  // a block with motion, while G66 is active
    find_macro,   // G66: checks whether the program exists
    user_code,    // M100 to M199: the subroutine of this code, in a file of its name
  };
  Kind kind = Kind::leave;
  bool good = true;  // false: the target is unknown
  std::int32_t program = 0;
  std::int32_t passes = 1;
  Span span;
  std::array<double, sub_parameters> arguments{};  // arguments of a macro or a user code: its #1 … #30

  bool is_macro() const { return kind != Kind::leave && kind != Kind::call && kind != Kind::user_code; }
  std::string_view code() const {
    switch (kind) {
      case Kind::leave: return "M99";
      case Kind::call: return "M98";
      case Kind::macro: return "G65";
      default: return "G66";
    }
  }
};

}  // namespace passo
