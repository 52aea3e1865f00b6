// MachineObserver: receives the steps and outputs of a simulated machine. Trace writers, counters and tests are
// observers.
#pragma once

#include "passo/units/units.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

class MachineObserver {
 public:
  virtual ~MachineObserver() = default;
  // At `time` the motors in `stepped` made a step. Motors that are also in `directions` stepped down. `stepped` is
  // never empty.
  virtual void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) = 0;
  virtual void on_outputs(Ticks /*time*/, const BoardOutputs& /*outputs*/) {}
};

}  // namespace passo
