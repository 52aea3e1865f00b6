// ToolTrack: the tool path of a program's operations, in the active work coordinate system.
//
// For observers of operations. A feed without axis words (`G1 F600`) is an operation, but not a move. An offset that is
// set to its present value does not count as a change.
#pragma once

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

class ToolTrack {
 public:
  // `start`: the machine position at the start.
  explicit ToolTrack(const Point& start) : to_(start) {}

  // Call it for each operation of the program, in order. The other functions then refer to that operation.
  void follow(const Operation& operation);

  // Returns true if the tool moves by more than a rounding error.
  bool moves() const { return moves_; }
  // Start and end in the active work coordinate system. Equal if the operation is not a move.
  const Point& from() const { return from_; }
  const Point& to() const { return to_; }
  // Returns true if the offsets or the rotation have changed, and so have the work coordinates.
  bool frame_changed() const { return frame_changed_; }

 private:
  Frame frame_;
  Point from_;
  Point to_;
  bool moves_ = false;
  bool frame_changed_ = false;
};

}  // namespace passo
