// Frame: converts work positions to machine positions. A frame is updated by the operations that change it.
//
// machine = work offset + rotate(work + G92 offset, rotation about Z) + tool offset
//
// as in LinuxCNC (find_ends and find_current_in_system of its interpreter): the G92 offset is rotated with the work
// frame, the tool offset is not. The interpreter and the path builder each keep a Frame.
#pragma once

#include "passo/geometry/axes.hpp"
#include "passo/geometry/curve.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

class Frame {
 public:
  // Updates the frame. Returns whether the operation changed it.
  bool follow(const Operation& operation);

  Point machine_from_work(const Point& work) const;
  Point work_from_machine(const Point& machine) const;
  // Returns the zero of the work coordinate system in machine coordinates.
  const Point& work_zero() const { return work_zero_; }
  // Returns the extents of a curve in machine coordinates along the work axes, relative to the work zero.
  Box work_extents(const Curve& curve) const;

  const Point& work_offset() const { return work_offset_; }
  const Point& g92_offset() const { return g92_offset_; }
  const Point& tool_offset() const { return tool_offset_; }
  double rotation_degrees() const { return rotation_degrees_; }
  int work_system() const { return work_system_; }

 private:
  bool take(const Operation& operation);

  Point work_offset_;
  Point g92_offset_;
  Point tool_offset_;
  Point work_zero_;
  double rotation_degrees_ = 0;
  double cosine_ = 1;
  double sine_ = 0;
  int work_system_ = 1;
};

}  // namespace passo
