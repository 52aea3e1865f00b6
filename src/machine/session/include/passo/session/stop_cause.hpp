// What has stopped a machine's motors at once, in words.
#pragma once

#include <cstdint>
#include <string>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct StopCause {
  std::string what;    // a sentence without a full stop, as "the emergency stop was pressed"
  std::string remedy;  // what to do first, as "release it"; empty: nobody knows
};

// `inputs`: those that stopped the motors, as bits of BoardInput; 0: the board does not know.
StopCause stop_cause(std::uint16_t inputs, const MachineDescription& machine);

}  // namespace passo
