// find_stop(): the point at which the path of a program continues after one of its stops (M0, M1, M6), with the present
// offsets and tools.
//
// While a program waits, a person may set another zero or measure a tool. The program is then interpreted again from
// its beginning, with the new values, and goes on behind the same stop. Offsets set by the program before that point
// would hide the new zero, so find_stop() reports them.
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
