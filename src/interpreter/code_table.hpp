// The G and M codes that the interpreter knows: number, modal group, what they are for.
//
// One line a code in code_table.cpp. Two codes of one group cannot stand in the same block.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace passo {

enum class ModalGroup : std::uint8_t {
  motion,           // G0 G1 G2 G3 G33 G33.1 G80
  plane,            // G17 G18 G19
  distance,         // G90 G91
  arc_distance,     // G90.1 G91.1
  feed_mode,        // G93 G94 G95
  units,            // G20 G21
  cutter,           // G40
  tool_length,      // G43 G43.1 G49
  retract,          // G98 G99
  work_offset,      // G54 … G59.3
  path,             // G61 G61.1 G64
  diameter,         // G7 G8
  spindle_mode,     // G97
  non_modal,        // G4 G10 G28 G30 G53 G92 …
  stopping,         // M0 M1 M2 M30 M60
  tool_change,      // M6 M61
  spindle,          // M3 M4 M5
  coolant,          // M7 M8 M9
  override_switch,  // M48 M49
};
inline constexpr std::size_t modal_group_count = 19;

struct Code {
  char letter = 'G';
  std::int32_t number = 0;  // in tenths: 382 is G38.2
  ModalGroup group = ModalGroup::motion;
  std::string_view meaning;
};

// Null where there is no such code.
const Code* find_code(char letter, std::int32_t tenths);
std::span<const Code> all_codes();
// "G38.2"
std::string_view group_name(ModalGroup group);

}  // namespace passo
