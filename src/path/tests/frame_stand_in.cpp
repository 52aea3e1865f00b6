// TEMPORARY: until interpreter/ has frame.cpp.
#include <cmath>
#include <numbers>

#include "passo/interpreter/frame.hpp"

namespace passo {

bool Frame::follow(const Operation& operation) {
  if (const auto* work = std::get_if<operation::SetWorkOffset>(&operation.what)) {
    work_offset_ = work->offset;
    work_system_ = work->system;
  } else if (const auto* g92 = std::get_if<operation::SetG92Offset>(&operation.what)) {
    g92_offset_ = g92->offset;
  } else if (const auto* tool = std::get_if<operation::SetToolOffset>(&operation.what)) {
    tool_offset_ = tool->offset;
  } else if (const auto* rotation = std::get_if<operation::SetRotation>(&operation.what)) {
    rotation_degrees_ = rotation->degrees;
    cosine_ = std::cos(rotation_degrees_ * std::numbers::pi / 180);
    sine_ = std::sin(rotation_degrees_ * std::numbers::pi / 180);
  } else {
    return false;
  }
  return true;
}

Point Frame::machine_from_work(const Point& work) const {
  Point point = work + g92_offset_;
  const double x = point[Axis::x];
  point[Axis::x] = x * cosine_ - point[Axis::y] * sine_;
  point[Axis::y] = x * sine_ + point[Axis::y] * cosine_;
  return point + work_offset_ + tool_offset_;
}

Point Frame::work_from_machine(const Point& machine) const {
  Point point = machine - tool_offset_ - work_offset_;
  const double x = point[Axis::x];
  point[Axis::x] = x * cosine_ + point[Axis::y] * sine_;
  point[Axis::y] = -x * sine_ + point[Axis::y] * cosine_;
  return point - g92_offset_;
}

}  // namespace passo
