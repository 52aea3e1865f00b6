// LinkMonitor: reports that a board on a serial link does not respond, as soon as a response is overdue, and the
// remaining waiting time.
#pragma once

#include <functional>
#include <string>

#include "passo/link/board_session.hpp"
#include "passo/units/units.hpp"

namespace passo {

class LinkMonitor {
 public:
  // The interval between checks.
  static constexpr Seconds between_looks{0.2};

  // `rewrites`: the output is a terminal on which a line can be rewritten, so the message counts down each second.
  // Otherwise it is written at the beginning and every ten seconds. `say` receives text including its newlines.
  LinkMonitor(bool rewrites, std::function<void(const std::string&)> say) : rewrites_(rewrites), say_(std::move(say)) {}

  // `silence`: for how long a response has been overdue. `patience`: the silence after which the run ends. `ended`: the
  // run has ended.
  void update(Seconds silence, Seconds patience, bool ended = false);
  void update(const BoardSession& board) { update(board.silent_for(), board.patience(), board.error().has_value()); }

 private:
  bool rewrites_;
  std::function<void(const std::string&)> say_;
  int told_ = -1;  // remaining seconds in the last message; negative: the board responds
};

// Returns a LinkMonitor that writes to standard error.
LinkMonitor link_monitor();

}  // namespace passo
