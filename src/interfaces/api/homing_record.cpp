#include "homing_record.hpp"

#include "passo/session/board_machine_session.hpp"

namespace passo {

void HomingRecord::on_change(MachineState state) {
  const BoardMachineSession* const own = session_.as_board_session();
  const HomingPath* const homing = own != nullptr ? own->homing() : nullptr;
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
