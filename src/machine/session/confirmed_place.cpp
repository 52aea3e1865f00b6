#include "passo/session/confirmed_place.hpp"

namespace passo {

bool is_place_confirmed(const MachineSession& session) {
  switch (session.status().position.trust) {
    case Trust::unknown: return false;
    case Trust::commanded: return session.as_board_session() != nullptr;
    case Trust::counted:
    case Trust::homed: return true;
  }
  return false;
}

}  // namespace passo
