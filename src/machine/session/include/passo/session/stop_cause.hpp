// The cause of an instant stop of the motors, in words.
#pragma once

#include <cstdint>
#include <string>

#include "passo/base/sentence.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct StopCause {
  enum class Kind : std::uint8_t { unknown, emergency_stop, drive_alarm, limit_switch_of_axis, limit_switch };
  std::string what;    // a sentence without a full stop, e.g. "the emergency stop was pressed"
  std::string remedy;  // what to do first, e.g. "release it"; empty: unknown
  Kind kind = Kind::unknown;
  SentenceArguments arguments = {};  // {axes}, {axis} or {number}, by kind
};

// `inputs`: those that stopped the motors, as bits of BoardInput; 0: the board does not know.
StopCause stop_cause(std::uint16_t inputs, const MachineDescription& machine);

}  // namespace passo
