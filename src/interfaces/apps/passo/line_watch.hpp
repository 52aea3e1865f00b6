// LineWatch: says that a board over a line is silent, as soon as it is, and how long it will be waited for.
#pragma once

#include <functional>
#include <string>

#include "passo/link/board_session.hpp"
#include "passo/units/units.hpp"

namespace passo {

class LineWatch {
 public:
  // How often to look.
  static constexpr Seconds between_looks{0.2};

  // `rewrites`: the words go to a terminal on which a line can be rewritten, so they count down each second. Elsewhere
  // they come at the beginning and every ten seconds. `say` gets text with its line ends.
  LineWatch(bool rewrites, std::function<void(const std::string&)> say) : rewrites_(rewrites), say_(std::move(say)) {}

  // `silence`: for how long an answer has been due. `patience`: after so long the run ends. `ended`: it has.
  void update(Seconds silence, Seconds patience, bool ended = false);
  void update(const BoardSession& board) { update(board.silent_for(), board.patience(), board.error().has_value()); }

 private:
  bool rewrites_;
  std::function<void(const std::string&)> say_;
  int told_ = -1;  // the seconds left that were told last; less than 0: the board answers
};

// To standard error.
LineWatch line_watch();

}  // namespace passo
