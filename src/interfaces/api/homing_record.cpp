#include "homing_record.hpp"

namespace passo {

void HomingRecord::on_change(MachineState state) {
  const HomingPath* const homing = session_.homing();
  if (state == MachineState::home && homing != nullptr) {
    const bool was_known = session_.status().position.trust == Trust::homed;
    from_ = was_known ? std::optional(homing->start()) : std::nullopt;
  } else if (homes_ && state == MachineState::idle && homing != nullptr && homing->done()) {
    homed_ = homing->homed();
    repeats_.record(homed_, from_);
  }
  homes_ = state == MachineState::home;
}

}  // namespace passo
