// FakeGrbl: a StrictGrbl on a TCP port of this computer.
#pragma once

#include "kit/board_on_port.hpp"
#include "kit/strict_grbl.hpp"

namespace passo::test {

using FakeGrbl = BoardOnPort<StrictGrbl>;

}  // namespace passo::test
