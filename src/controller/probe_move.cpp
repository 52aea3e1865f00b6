#include "passo/controller/probe_move.hpp"

#include <cmath>

namespace passo {

void ProbeMove::guard_other_moves() {
  guards_ = true;
  link_.watch_probe(ProbeUntil::touched);
}

void ProbeMove::begin(const Action& action) {
  link_.watch_probe(action.probe_toward ? ProbeUntil::touched : ProbeUntil::released, action.limit);
  start_ = action.place;
  outcome_ = {.refused = link_.probe_report().touched == action.probe_toward,
              .touched = false,
              .contact = start_,
              .rest = start_};
  running_ = true;
  if (told_ != nullptr) *told_ = outcome_;
}

void ProbeMove::end(const Point& rest) {
  running_ = false;
  if (!outcome_.refused) {
    link_.recall_contact();
    outcome_.rest = rest;
    outcome_.touched = contact();
    outcome_.contact = outcome_.touched ? contact_place(link_.probe_report()) : rest;
  }
  link_.watch_probe(guards_ ? ProbeUntil::touched : ProbeUntil::off);
  if (told_ != nullptr) *told_ = outcome_;
  for (const auto& watcher : watchers_) watcher(outcome_);
}

// An axis that made no step stands where it stood, between two steps or not.
Point ProbeMove::contact_place(const ProbeReport& report) const {
  Point place = start_;
  for (std::size_t m = 0; m < steps_.motor_count; ++m) {
    if (report.steps[m] == 0) continue;
    const Motor& motor = steps_.motors[m];
    const double steps = std::round(start_[motor.axis] * motor.steps_per_unit) + report.steps[m];
    place[motor.axis] = steps / motor.steps_per_unit;
  }
  return place;
}

}  // namespace passo
