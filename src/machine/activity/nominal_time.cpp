#include "passo/activity/nominal_time.hpp"

#include <algorithm>
#include <variant>

namespace passo {

Seconds nominal_time_of(const PathItem& item, const MotionLimits& limits) {
  const auto* action = std::get_if<Action>(&item);
  const OperationSource& source = action != nullptr ? action->source : std::get<Segment>(item).source;
  if (source.inserted) return Seconds(0);
  if (action != nullptr) return action->dwell;
  const auto& segment = std::get<Segment>(item);
  double speed = speed_within(segment.curve.steepest_bound(), segment.speed.value(), limits);
  // The exact slopes cost the trigonometry of an arc. They count only where the bound is felt.
  if (speed < segment.speed.value()) speed = speed_within(segment.curve.steepest(), segment.speed.value(), limits);
  return speed > 0 ? segment.curve.length() / MmPerSecond(speed) : Seconds(0);
}

Seconds nominal_time_of(const PlannedMove& move, const MotionLimits& limits) {
  return nominal_time_of(PathItem(move.segment), limits) * ((move.to - move.from()) / move.segment.curve.length());
}

}  // namespace passo
