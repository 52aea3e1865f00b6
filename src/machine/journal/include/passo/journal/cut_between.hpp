// cut_between: what a program cuts between two positions of its path, found by interpreting it again.
//
// For the life of tools after a host was killed: its journal has the position at which the job began, and that at which
// the board has stopped. The length is exact; the time is that at the programmed feeds.
#pragma once

#include <string>
#include <vector>

#include "passo/activity/cut_meter.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/journal/journal.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// `probes`: the results of the program's first probe moves.
CutAmounts cut_between(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                       const PathPosition& first, const PathPosition& last,
                       const std::vector<ProbeOutcome>& probes = {});

// Identifies the run that a journal belongs to.
std::string run_of(const JournalHead& head);

}  // namespace passo
