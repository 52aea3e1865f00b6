// Several moves, from point to point: `passo interpolate --to "10,4 27,10"`. The end of a move is the start of the next
// one, at which the method begins anew. Each move gets its time from its length, because the speed is constant.
#pragma once

#include <vector>

#include "commands.hpp"
#include "pulse_table.hpp"

#include "passo/base/result.hpp"
#include "passo/study/method.hpp"

namespace passo {

// Returns the moves of --from and --to: one for each point. The error text can follow "passo: error: ".
Result<std::vector<StepMove>, std::string> step_moves_of(const InterpolateArguments& arguments);

// Returns the time of each move, from --time (of all moves together) or --feed; empty: neither was given.
Result<std::vector<Seconds>, std::string> times_of(const InterpolateArguments& arguments,
                                                   const std::vector<StepMove>& moves);

// Prints the pulses of all moves, or with --step-times or --json the figures of each move. Returns the exit code.
int point_after_point(const InterpolateArguments& arguments, const Method& method, const std::vector<StepMove>& moves,
                      const PulseTable& table);

}  // namespace passo
