#include "passo/api/motion_times.hpp"

#include <algorithm>
#include <utility>

#include "passo/activity/nominal_time.hpp"
#include "passo/activity/stage_options.hpp"

namespace passo {

void MotionTimes::add(Seconds nominal, Seconds planned) {
  last_ = {nominal, planned};
  if (planned - points_.back().planned < apart_) return;
  points_.push_back(last_);
  if (points_.size() < most_points) return;
  apart_ = planned * (2.0 / most_points);
  std::size_t kept = 0;
  for (const Point& point : points_) {
    if (kept == 0 || point.planned - points_[kept - 1].planned >= apart_) points_[kept++] = point;
  }
  points_.resize(kept);
}

Seconds MotionTimes::left_from(Seconds nominal) const {
  if (nominal >= last_.nominal) return Seconds(0);
  const auto after = std::ranges::upper_bound(points_, nominal, {}, &Point::nominal);
  const Point& to = after == points_.end() ? last_ : *after;
  const Point& from = after == points_.begin() ? points_.front() : *(after - 1);
  const Seconds between = to.nominal - from.nominal;
  const double share = between > Seconds(0) ? std::clamp((nominal - from.nominal) / between, 0.0, 1.0) : 0;
  return whole() - from.planned - (to.planned - from.planned) * share;
}

std::optional<MotionTimes> time_motion(const MotionTiming& wanted, const MachineDescription& machine,
                                       const std::function<bool()>& goes_on) {
  constexpr unsigned items_between_looks = 64;
  const MotionLimits limits = motion_limits(machine);
  PlannedProgram program(ProgramReader::from_text(wanted.name, wanted.text), machine, wanted.options, wanted.check,
                         wanted.factors);
  MotionTimes times;
  Seconds nominal{0};
  Seconds planned{0};
  MotionItem item;
  for (unsigned items = 1; program.next(item); ++items) {
    if (items % items_between_looks == 0 && !goes_on()) return {};
    if (const auto* move = std::get_if<PlannedMove>(&item)) {
      nominal += nominal_time_of(*move, limits);
      planned += move->duration();
    } else {
      nominal += std::get<Action>(item).dwell;
      planned += std::get<Action>(item).dwell;
    }
    times.add(nominal, planned);
  }
  return times;
}

}  // namespace passo
