// GrblMemory: the persistent memory of a Grbl controller, like grbl's EEPROM: the start-up lines, the build info, and a
// sender's report settings. (Machine settings are in the machine file, offsets in the parameter file.)
//
// Stored as text lines in the format that senders use: "$10=3", "$I=SHOP", "$N0=G54".
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "passo/grbl/grbl_settings.hpp"

namespace passo {

struct GrblMemory {
  // Maximum length of a start-up line and of the build info, as in grbl: the longest line of its EEPROM.
  static constexpr std::size_t longest = 79;

  GrblChoices choices;
  std::string build;                   // the build info, set by $I=
  std::array<std::string, 2> startup;  // the start-up lines, set by $N0= and $N1=
  friend bool operator==(const GrblMemory&, const GrblMemory&) = default;
};

std::string grbl_memory_text(const GrblMemory& memory);
// Ignores invalid lines: a damaged file loses settings, but does not prevent the machine from starting.
GrblMemory read_grbl_memory(std::string_view text);

}  // namespace passo
