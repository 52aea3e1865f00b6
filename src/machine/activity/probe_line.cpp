#include "passo/activity/probe_line.hpp"

namespace passo {

bool ProbeLine::next(PathItem& item) {
  if (step_ == Step::begin) {
    step_ = Step::move;
    item = Action{.kind = Action::Kind::probe_begin, .probe_toward = toward_, .place = start_};
    return true;
  }
  const bool refused = answers_.probe()->refused;
  if (step_ == Step::move && !refused && target_ != start_) {
    step_ = Step::end;
    item = Segment{.curve = Curve::line(start_, target_), .speed = speed_, .mode = PathMode::exact_stop};
    return true;
  }
  if (step_ == Step::done) return false;
  step_ = Step::done;
  item = Action{.kind = Action::Kind::probe_end, .probe_toward = toward_, .place = refused ? start_ : target_};
  return true;
}

std::optional<ActivityFault> ProbeLine::fault() const {
  const ProbeOutcome& outcome = *answers_.probe();
  if (outcome.refused) return ActivityFault{MachineFault::probe_before};
  if (!outcome.touched) return ActivityFault{MachineFault::probe_untouched};
  return {};
}

}  // namespace passo
