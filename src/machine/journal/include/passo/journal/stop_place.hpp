// find_stop(): the point at which the path of a program continues after one of its stops (M0, M1, M6), with the present
// offsets and tools.
//
// While a program waits, the operator may set another zero or measure a tool. The program is then interpreted again
// from its beginning, with the new values, and continues after the same stop. Offsets set by the program before that
// point would hide the new zero, so find_stop() reports them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/journal/resume_point.hpp"

namespace passo {

struct StopPlace {
  ResumePoint at;              // after the stop
  std::uint32_t line = 0;      // line of the stop
  std::uint8_t system = 1;     // the active work offset there: 1 is G54
  bool sets_own_zero = false;  // the program itself has set a work offset, G92 or a tool before
};

// `number`: the number of the stop, from 1. `probes`: the results of the program's first probe moves. Empty: there is
// no such stop, or the program has errors.
std::optional<StopPlace> find_stop(const ProgramReader& program, const MachineDescription& machine,
                                   const InterpreterOptions& options, std::uint64_t number,
                                   const std::vector<ProbeOutcome>& probes);

}  // namespace passo
