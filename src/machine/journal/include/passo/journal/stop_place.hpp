// find_stop(): where the path of a program goes on behind one of its stops (M0, M1, M6), with the offsets and tools
// that count now.
//
// While a program waits, a person may set another zero or measure a tool. The program is then interpreted again from
// its beginning, with the new values, and goes on behind the same stop. What the program itself has set on the way
// there would hide the new zero, so find_stop() tells it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/journal/resume_point.hpp"

namespace passo {

struct StopPlace {
  ResumePoint at;              // behind the stop
  std::uint32_t line = 0;      // of the stop
  std::uint8_t system = 1;     // the work system in force there: 1 is G54
  bool sets_own_zero = false;  // the program has set a work offset, G92 or a tool itself before
};

// `number`: which stop, from 1. `probes`: what the program's first probe moves have found. Empty: there is no such
// stop, or the program has errors.
std::optional<StopPlace> find_stop(const ProgramReader& program, const MachineDescription& machine,
                                   const InterpreterOptions& options, std::uint64_t number,
                                   const std::vector<ProbeOutcome>& probes);

}  // namespace passo
