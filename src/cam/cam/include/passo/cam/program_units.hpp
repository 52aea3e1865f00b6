// ProgramUnits: what the numbers of a program that cam/ writes count.
#pragma once

#include <cstdint>

namespace passo {

// There is no G-code for centimetres: such a program notes the unit in a comment, and is for machines that use
// centimetres.
enum class ProgramUnits : std::uint8_t { mm, cm, inch };

}  // namespace passo
