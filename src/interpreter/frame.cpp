#include "passo/interpreter/frame.hpp"

#include <cmath>
#include <numbers>

namespace passo {
namespace {

void rotate(Point& point, double cosine, double sine) {
  const double x = point[Axis::x];
  const double y = point[Axis::y];
  point[Axis::x] = x * cosine - y * sine;
  point[Axis::y] = x * sine + y * cosine;
}

}  // namespace

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
    cosine_ = rotation_degrees_ == 0 ? 1 : std::cos(rotation_degrees_ * std::numbers::pi / 180);
    sine_ = rotation_degrees_ == 0 ? 0 : std::sin(rotation_degrees_ * std::numbers::pi / 180);
  } else {
    return false;
  }
  return true;
}

Point Frame::machine_from_work(const Point& work) const {
  Point machine = work + g92_offset_;
  if (rotation_degrees_ != 0) rotate(machine, cosine_, sine_);
  return machine + work_offset_ + tool_offset_;
}

Point Frame::work_from_machine(const Point& machine) const {
  Point work = machine - tool_offset_ - work_offset_;
  if (rotation_degrees_ != 0) rotate(work, cosine_, -sine_);
  return work - g92_offset_;
}

}  // namespace passo
