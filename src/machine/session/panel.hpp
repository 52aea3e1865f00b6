// Panel: the buttons and the door of a board, and the corresponding requests. Private to session/.
//
// The board immediately reports a pressed button. The panel also queries the board from time to time, because a message
// may be lost. Feed hold stops on the path; cycle start resumes. An open door is a hold too: the machine resumes when
// the door is closed and the operator presses cycle start.
#pragma once

#include "passo/session/board_machine_session.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class BoardMachineSession::Panel {
 public:
  // In a hold the operator is probably near, so the panel queries more often, to detect a start soon.
  static constexpr Seconds between_questions{0.2};
  static constexpr Seconds in_a_hold{0.05};

  // The board must outlive the panel.
  explicit Panel(BoardSession& board) : board_(board) {}

  void ask(bool holds) {
    if (board_.now() - asked_ < (holds ? in_a_hold : between_questions)) return;
    asked_ = board_.now();
    board_.ask();
  }
  struct Pressed {
    bool hold = false;
    bool door = false;
    bool start = false;  // cycle start, unless hold is pressed or the door is open
  };
  Pressed take_pressed() {
    const unsigned pressed = board_.take_pressed();
    const bool barred = (board_.inputs() & (input_hold | input_door)) != 0;
    const bool holds = (pressed & (input_hold | input_door)) != 0;
    return {.hold = (pressed & input_hold) != 0,
            .door = (pressed & input_door) != 0,
            .start = (pressed & input_start) != 0 && !holds && !barred};
  }
  bool door_is_open() const { return (board_.inputs() & input_door) != 0; }

 private:
  BoardSession& board_;
  Seconds asked_{0};
};

}  // namespace passo
