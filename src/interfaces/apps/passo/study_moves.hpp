// What the commands that study one move make of their words: a move in steps, its time, the request for a ramp.
// `passo windings` takes the same words as `passo interpolate` and `passo ramp`.
#pragma once

#include <optional>
#include <string>

#include "commands.hpp"

#include "passo/base/result.hpp"
#include "passo/ramp/ramp_sequence.hpp"
#include "passo/study/method.hpp"

namespace passo {

// The errors' words fit after "passo: error: ".
Result<StepMove, std::string> step_move_of(const InterpolateArguments& arguments);
Result<Method, std::string> method_of(const InterpolateArguments& arguments);
// The time of the whole move, as --time or --feed says it; empty: neither was given.
Result<std::optional<Seconds>, std::string> time_of(const InterpolateArguments& arguments, const StepMove& move);

// What is wrong with the numbers of a ramp; empty: nothing.
std::string wrong_number(const RampArguments& arguments);
// For arguments whose numbers are right, with clock, acceleration and steps a turn.
RampRequest ramp_request_of(const RampArguments& arguments);

}  // namespace passo
