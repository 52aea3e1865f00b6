#include "passo/interpreter/frame.hpp"

#include <cmath>
#include <numbers>
#include <variant>

namespace passo {
namespace {

struct Direction {
  double cosine = 1;
  double sine = 0;
};

// Quarter turns are exact: a frame turned by 90 degrees must not leave 6e-17 of X in Y.
Direction direction_of(double degrees) {
  const double quarters = degrees / 90;
  if (quarters == std::round(quarters) && std::abs(quarters) < 1e9) {
    constexpr Direction exact[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return exact[static_cast<unsigned>(static_cast<long>(quarters)) & 3U];
  }
  const double radians = degrees * (std::numbers::pi / 180);
  return {std::cos(radians), std::sin(radians)};
}

void rotate(Point& point, double cosine, double sine) {
  const double x = point[Axis::x];
  const double y = point[Axis::y];
  point[Axis::x] = x * cosine - y * sine;
  point[Axis::y] = x * sine + y * cosine;
}

}  // namespace

bool Frame::follow(const Operation& operation) {
  if (!take(operation)) return false;
  work_zero_ = machine_from_work(Point());
  return true;
}

bool Frame::take(const Operation& operation) {
  if (const auto* work = std::get_if<operation::SetWorkOffset>(&operation.what)) {
    work_offset_ = work->offset;
    work_system_ = work->system;
    return true;
  }
  if (const auto* g92 = std::get_if<operation::SetG92Offset>(&operation.what)) {
    g92_offset_ = g92->offset;
    return true;
  }
  if (const auto* rotation = std::get_if<operation::SetRotation>(&operation.what)) {
    rotation_degrees_ = rotation->degrees;
    const Direction direction = direction_of(rotation->degrees);
    cosine_ = direction.cosine;
    sine_ = direction.sine;
    return true;
  }
  if (const auto* tool = std::get_if<operation::SetToolOffset>(&operation.what)) {
    tool_offset_ = tool->offset;
    return true;
  }
  return false;
}

Point Frame::machine_from_work(const Point& work) const {
  Point point = work + g92_offset_;
  rotate(point, cosine_, sine_);
  return point + work_offset_ + tool_offset_;
}

Point Frame::work_from_machine(const Point& machine) const {
  Point point = machine - work_offset_ - tool_offset_;
  rotate(point, cosine_, -sine_);
  return point - g92_offset_;
}

Box Frame::work_extents(const Curve& curve) const {
  Point zero = work_zero_;
  Box box;
  if (rotation_degrees_ == 0) {
    box = curve.extents();
  } else {
    box = curve.turned(cosine_, -sine_).extents();
    rotate(zero, cosine_, -sine_);
  }
  return {.low = box.low - zero, .high = box.high - zero};
}

}  // namespace passo
