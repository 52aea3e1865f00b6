// The words for a stop at once: which switch it was, where in the program, and what to do.
#pragma once

#include <cstdint>
#include <string>

#include "opened_machine.hpp"

#include "passo/job/motion_lines.hpp"

namespace passo {

// For a board that has stopped its motors at once: a sentence without a full stop, with a code. Ends the conversation
// with the board, because it asks which switches are closed. `program`: its name; empty: no program moved the machine.
// `known_line`: where that was, if it is known otherwise than by the place.
std::string stop_words(OpenedMachine& opened, const MachineDescription& machine, const std::string& program = {},
                       const LatestMotion& motion = {}, std::uint32_t known_line = 0);

// The same for a board that has stood still amid motion. `line` as known_line.
std::string slip_words(OpenedMachine& opened, const MachineDescription& machine, const std::string& program = {},
                       std::uint32_t line = 0);
// Near which line of the program the board told that the motors have stood still. 0: not known.
std::uint32_t line_of_standstill(OpenedMachine& opened, const MachineDescription& machine, const LatestMotion& motion);

}  // namespace passo
