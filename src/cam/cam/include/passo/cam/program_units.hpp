// ProgramUnits: the length unit of the programs that cam/ writes.
#pragma once

#include <cstdint>

namespace passo {

// There is no G-code for centimetres: such a program states the unit in a comment, and is for machines that use
// centimetres.
enum class ProgramUnits : std::uint8_t { mm, cm, inch };

}  // namespace passo
