// OperatorPanel: the buttons and the door of a board, and what a drive does when somebody uses them.
//
// Feed hold brakes on the path, as MotionDrive::hold(); cycle start goes on. An open door is a hold too: the drive goes
// on when it is closed and somebody presses cycle start. All that only where the program heeds holds (M53).
#pragma once

#include "passo/drive/motion_drive.hpp"

namespace passo {

class OperatorPanel {
 public:
  // The drive outlives it.
  explicit OperatorPanel(MotionDrive& drive) : drive_(drive) {}

  // Between any two steps of the drive. In its hold it lets some time pass.
  void look();
  // Somebody has pressed hold, or opened the door, and not yet pressed start.
  bool holds() const { return holds_; }

 private:
  void act(std::uint16_t pressed);

  MotionDrive& drive_;
  bool holds_ = false;
  Seconds asked_{0};
};

}  // namespace passo
