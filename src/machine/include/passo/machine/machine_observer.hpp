// What a virtual machine tells those who watch it (trace writers, counters, tests).
#pragma once

#include "passo/units/units.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

class MachineObserver {
 public:
  virtual ~MachineObserver() = default;
  // At `time` the motors in `stepped` made a step; those also in `directions` counted down. Never called with none.
  virtual void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) = 0;
  virtual void on_outputs(Ticks /*time*/, const BoardOutputs& /*outputs*/) {}
};

}  // namespace passo
