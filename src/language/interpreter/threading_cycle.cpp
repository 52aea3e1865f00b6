#include "threading_cycle.hpp"

#include <cmath>

namespace passo {

bool ThreadingCycle::step() {
  // Depths are compared from the drive line and in the program's units. So a pass that is about K deep is rounded as in
  // LinuxCNC.
  const double crest = plan_.crest;
  const double depth = plan_.first_cut * std::pow(pass_, 1 / plan_.degression);
  if (!full_depth_reached_ && crest + depth < crest + plan_.full_depth) {
    cut(depth * plan_.unit);
    ++pass_;
    return true;
  }
  full_depth_reached_ = true;
  cut(plan_.full_depth * plan_.unit);
  if (--springs_left_ >= 0) return true;
  traverse(plan_.end);
  return false;
}

// The depth is in millimetres.
void ThreadingCycle::cut(double depth) {
  const ThreadingPlan& thread = plan_;
  const double back = thread.infeed_tangent;
  const double full_depth = thread.full_depth * thread.unit;
  const double above = thread.start[Axis::x] + thread.outward * (full_depth - depth);
  const double crest = above - thread.outward * (thread.crest * thread.unit);
  const double bottom = crest - thread.outward * full_depth;
  const double first = thread.start[Axis::z] - depth * back;
  const double last = thread.end[Axis::z] + (full_depth - depth) * back;
  const double slope_pitch =
      thread.taper == 0 ? thread.pitch : thread.pitch * std::hypot(thread.taper, full_depth) / std::abs(thread.taper);
  Point at = thread.start;
  const auto rapid = [&](double x, double z) {
    at[Axis::x] = x, at[Axis::z] = z;
    traverse(at);
  };
  const auto feed_to = [&](double x, double z) {
    at[Axis::x] = x, at[Axis::z] = z;
    feed(at);
  };

  rapid(above, first);
  if (!thread.taper_at_start) rapid(bottom, first);
  emit(operation::SetFeedOverride{false});
  if (thread.taper_at_start) {
    emit(operation::StartSpeedFeedSync{Mm(slope_pitch), false});
    feed_to(crest, first);
    feed_to(bottom, first - thread.taper);
  }
  emit(operation::StartSpeedFeedSync{Mm(thread.pitch), false});
  feed_to(bottom, thread.taper_at_end ? last + thread.taper : last);
  if (thread.taper_at_end) {
    emit(operation::StartSpeedFeedSync{Mm(slope_pitch), false});
    feed_to(crest, last);
  }
  emit(operation::StopSpeedFeedSync{});
  rapid(above, last);
  if (thread.feed_override) emit(operation::SetFeedOverride{true});
}

}  // namespace passo
