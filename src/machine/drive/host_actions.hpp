// The actions of a path that the drive performs during a stop, before the path continues. Private to drive/.
#pragma once

#include "passo/drive/program_stop.hpp"

namespace passo {

// Returns true if the action only changes outputs, which the board switches during motion.
constexpr bool is_for_outputs(const Action& action, bool waits_for_operator) {
  using Kind = Action::Kind;
  switch (action.kind) {
    case Kind::probe_begin:
    case Kind::probe_end:
    case Kind::await_index:
    case Kind::await_speed:
    case Kind::await_line:
    case Kind::tap_turns:
    case Kind::feed_hold: return false;
    default: return !(waits_for_operator && is_program_stop(action));
  }
}

}  // namespace passo
