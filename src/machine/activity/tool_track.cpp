#include "passo/activity/tool_track.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "passo/interpreter/is_any_of.hpp"

namespace passo {
namespace {

constexpr double least_move = 1e-6;  // mm: less is rounding

bool differ(const Point& a, const Point& b) {
  return std::ranges::any_of(all_axes, [&](Axis axis) { return std::abs(a[axis] - b[axis]) > least_move; });
}

bool differ(const Frame& a, const Frame& b) {
  return differ(a.work_offset(), b.work_offset()) || differ(a.g92_offset(), b.g92_offset()) ||
         differ(a.tool_offset(), b.tool_offset()) || a.rotation_degrees() != b.rotation_degrees();
}

std::optional<Point> end_of(const OperationKind& what, const Point& from) {
  using namespace operation;
  if (const auto* rapid = std::get_if<StraightTraverse>(&what)) return rapid->end;
  if (const auto* line = std::get_if<StraightFeed>(&what)) return line->end;
  if (const auto* arc = std::get_if<ArcFeed>(&what)) return arc->end;
  if (const auto* probe = std::get_if<StraightProbe>(&what)) return probe->end;
  if (const auto* curve = std::get_if<NurbsFeed>(&what); curve != nullptr && !curve->points.empty()) {
    Point end = from;
    end[Axis::x] = curve->points.back().x;
    end[Axis::y] = curve->points.back().y;
    return end;
  }
  return {};
}

}  // namespace

void ToolTrack::follow(const Operation& operation) {
  from_ = to_;
  frame_changed_ = false;
  // A frame is large, and few operations move it.
  if (is_any_of<operation::SetWorkOffset, operation::SetG92Offset, operation::SetRotation, operation::SetToolOffset>(
          operation)) {
    const Frame before = frame_;
    frame_.follow(operation);
    frame_changed_ = differ(before, frame_);
    to_ = from_ = frame_.work_from_machine(before.machine_from_work(to_));
  }
  to_ = end_of(operation.what, from_).value_or(from_);
  moves_ = is_any_of<operation::ArcFeed, operation::NurbsFeed, operation::RigidTap>(operation) || differ(from_, to_);
}

}  // namespace passo
