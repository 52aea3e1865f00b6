// Converts the arguments of the commands that study one move: a move in steps, its time, the request for a ramp. `passo
// windings` takes the same arguments as `passo interpolate` and `passo ramp`.
#pragma once

#include <optional>
#include <string>

#include "commands.hpp"

#include "passo/base/result.hpp"
#include "passo/ramp/ramp_sequence.hpp"
#include "passo/study/method.hpp"

namespace passo {

// The error text can follow "passo: error: ".
Result<StepMove, std::string> step_move_of(const InterpolateArguments& arguments);
Result<Method, std::string> method_of(const InterpolateArguments& arguments);
// Returns the time of the whole move, from --time or --feed; empty: neither was given.
Result<std::optional<Seconds>, std::string> time_of(const InterpolateArguments& arguments, const StepMove& move);

// Returns the error in the numbers of a ramp; empty: they are valid.
std::string wrong_number(const RampArguments& arguments);
// The arguments must be valid, and must include clock, acceleration and steps per revolution.
RampRequest ramp_request_of(const RampArguments& arguments);

}  // namespace passo
