// ToolTrack: where a program's operations lead the tool, in the work frame in force.
//
// For those who look at operations. A feed without axis words (`G1 F600`) is an operation, but no move. A frame that is
// set to what it is already does not move.
#pragma once

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

class ToolTrack {
 public:
  // `start`: the machine position at the start.
  explicit ToolTrack(const Point& start) : to_(start) {}

  // Call it for each operation of the program, in order. The others then tell of that operation.
  void follow(const Operation& operation);

  // The tool moves, by more than rounding.
  bool moves() const { return moves_; }
  // In the frame in force. Equal where the operation is no move.
  const Point& from() const { return from_; }
  const Point& to() const { return to_; }
  // The offsets or the rotation have changed, and so have the places in the frame.
  bool frame_changed() const { return frame_changed_; }

 private:
  Frame frame_;
  Point from_;
  Point to_;
  bool moves_ = false;
  bool frame_changed_ = false;
};

}  // namespace passo
