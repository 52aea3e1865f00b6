// ModalSnapshot: the part of the modal state that M70 and M73 save and M72 restores. There is one for the main program
// and one for each running subroutine. It excludes the motion code, positions and work offsets.
#pragma once

#include "program_state.hpp"

namespace passo {

struct ModalSnapshot {
  bool valid = false;
  bool restore_at_return = false;  // saved by M73
  ModalState modal;
  Point tool_offset;
  double feed = 0;
  std::array<SpindleState, most_spindles> spindles;
  PathTolerance tolerance;
  bool mist = false;
  bool flood = false;
  bool feed_override = true;
  bool adaptive_feed = false;
  bool feed_hold = true;
};

ModalSnapshot snapshot_of(const ProgramState& state);

}  // namespace passo
