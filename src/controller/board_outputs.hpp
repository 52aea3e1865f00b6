// What the outputs of a path's action are on the wire. Private to controller/.
#pragma once

#include "passo/path/segment.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

BoardOutputs board_outputs(const OutputState& state);

}  // namespace passo
