#include "passo/trajectory/planner.hpp"

#include "speed_law.hpp"

#include "passo/base/ensure.hpp"

namespace passo {

class Planner::Implementation {
 public:
  Implementation(Source<PathItem>& source, const MotionLimits& limits_of_axes, std::size_t most_queued)
      : path(source), limits(limits_of_axes) {
    const LawInputs inputs{.path = path, .limits = limits, .wishes = wishes, .most_queued = most_queued};
    law = limits.limits_jerk() ? jerk_law(inputs) : acceleration_law(inputs);
    law->begin();
  }

  // Whether the wishes keep the motion from going on from its present place.
  bool stands() {
    if (!wishes.any()) return false;
    const Segment* segment = path.front();
    return segment == nullptr ? wishes.stands_before(path.action()) : wishes.stands_on(*segment);
  }

  template <class Change>
  void wish(const Change& change) {
    const FeedFactors before = wishes.feeds;
    change(wishes);
    if (wishes.feeds != before) law->feeds_changed();
  }

  PathAhead path;
  const MotionLimits limits;
  MidRunWishes wishes;
  OutputState outputs;  // after the last action
  std::unique_ptr<SpeedLaw> law;
};

Planner::Planner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued)
    : implementation_(std::make_unique<Implementation>(path, limits, most_queued)) {}
Planner::~Planner() = default;

bool Planner::next(MotionItem& item) {
  Implementation& own = *implementation_;
  const bool stands = own.stands();
  auto* move = std::get_if<PlannedMove>(&item);
  if (move == nullptr) move = &item.emplace<PlannedMove>();
  if (stands ? own.law->brake(*move) : own.law->go_on(*move)) {
    ensure(move->phase_count > 0 && move->from() <= move->to);  // and StepGenerator takes no other
    if (move->to >= move->segment.curve.length()) own.path.pop();
    return true;
  }
  if (stands) {
    item = Action{.kind = Action::Kind::feed_hold, .outputs = own.outputs};
    return true;
  }
  const std::optional<Action> action = own.path.take_action();
  if (!action) return false;
  own.outputs = action->outputs;
  item = *action;
  own.law->begin();
  return true;
}

void Planner::limit_moves_to(Seconds duration) {
  implementation_->wishes.longest_move = duration;
}
void Planner::set_feed_override(double factor) {
  implementation_->wish([factor](MidRunWishes& wishes) { wishes.feeds.override = factor; });
}
void Planner::set_adaptive_feed(double factor) {
  implementation_->wish([this, factor](MidRunWishes& wishes) {
    wishes.feeds.adaptive = factor;
    wishes.feeds.limits = &implementation_->limits;
  });
}
void Planner::set_rapid_override(double factor) {
  implementation_->wish([&](MidRunWishes& wishes) {
    wishes.feeds.rapids = factor;
    wishes.feeds.limits = &implementation_->limits;
  });
}
void Planner::set_spindle_ratio(double ratio) {
  implementation_->wish([ratio](MidRunWishes& wishes) { wishes.feeds.spindle = ratio; });
}
void Planner::limit_speed_to(MmPerSecond speed) {
  implementation_->wish([speed](MidRunWishes& wishes) { wishes.feeds.top = speed.value(); });
}
void Planner::hold() {
  implementation_->wishes.hold = true;
}
void Planner::stop() {
  implementation_->wishes.stop = true;
}
void Planner::resume() {
  implementation_->wishes.hold = implementation_->wishes.stop = false;
}

void Planner::braking_plan(std::vector<PlannedMove>& plan, Braking how) const {
  plan.clear();
  implementation_->law->braking_plan(how, plan);
}
bool Planner::go_on(PathMode last) {
  if (!implementation_->path.go_on(last)) return false;
  implementation_->law->path_grew();
  return true;
}
void Planner::drop_to_action() {
  implementation_->path.drop_to_action();
  implementation_->law->begin();
}
void Planner::restart() {
  implementation_->path.restart();
  implementation_->law->begin();
}

}  // namespace passo
