// The messages for an instant stop: which switch caused it, where in the program, and what to do.
#pragma once

#include <cstdint>
#include <string>

#include "machine_connection.hpp"

#include "passo/job/motion_lines.hpp"

namespace passo {

// Describes an instant stop of the board's motors: a sentence without a full stop, with a code. Ends the communication
// with the board, because it queries which switches are closed. `program`: its name; empty: no program moved the
// machine. `known_line`: the program line, if it is known independently of the position.
std::string stop_words(MachineConnection& opened, const MachineDescription& machine, const std::string& program = {},
                       const LatestMotion& motion = {}, std::uint32_t known_line = 0);

// Does the same for a board that stopped during motion because events were late. `line`: as known_line.
std::string slip_words(MachineConnection& opened, const MachineDescription& machine, const std::string& program = {},
                       std::uint32_t line = 0);
// Returns the approximate program line at which, according to the board, the motors stopped. 0: unknown.
std::uint32_t line_of_standstill(MachineConnection& opened, const MachineDescription& machine,
                                 const LatestMotion& motion);

}  // namespace passo
