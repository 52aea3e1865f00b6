// GrblMemory: what a Grbl controller keeps over a restart, as grbl does in its EEPROM: the lines of a start, the words
// of its build, and what a sender has chosen for its reports. (Settings of the machine are in its file, offsets in
// theirs.)
//
// Kept as a text of lines that senders know: "$10=3", "$I=SHOP", "$N0=G54".
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "passo/grbl/grbl_settings.hpp"

namespace passo {

struct GrblMemory {
  // Of a start line and of the build's words, as in grbl: the longest line of its EEPROM.
  static constexpr std::size_t longest = 79;

  GrblChoices choices;
  std::string build;                   // $I=
  std::array<std::string, 2> startup;  // $N0=, $N1=
  friend bool operator==(const GrblMemory&, const GrblMemory&) = default;
};

std::string grbl_memory_text(const GrblMemory& memory);
// Lines that mean nothing are passed over: a damaged text costs what it says, and not the start of the machine.
GrblMemory read_grbl_memory(std::string_view text);

}  // namespace passo
