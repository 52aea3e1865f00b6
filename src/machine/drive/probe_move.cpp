#include "passo/drive/probe_move.hpp"

#include <cmath>

namespace passo {

void ProbeMove::ask_to_watch(const Action& action) {
  link_.watch_probe(action.probe_toward ? ProbeUntil::touched : ProbeUntil::released, action.limit);
}

void ProbeMove::begin(const Action& action, AxisSet downs) {
  start_ = action.place;
  downs_ = downs;
  outcome_ = {.refused = link_.probe_report().touched == action.probe_toward,
              .touched = false,
              .contact = start_,
              .rest = start_};
  running_ = true;
  contact_seen_ = false;
  end_.reset();
  answers_.record(outcome_);
}

void ProbeMove::recall() {
  running_ = false;
  if (!outcome_.refused) link_.recall_contact();
}

void ProbeMove::find(const Point& planned_end) {
  if (outcome_.refused) return;
  const Point rest = end_.value_or(planned_end);
  outcome_.rest = rest;
  outcome_.touched = contact();
  outcome_.contact = outcome_.touched ? contact_place(link_.probe_report(), rest) : rest;
}

void ProbeMove::end() {
  contact_seen_ = false;
  answers_.record(outcome_);
  for (const auto& watcher : watchers_) watcher(outcome_);
}

// An axis that made no step stands where it stood, even if that is between two steps. The move was a straight line, so
// its direction tells on which side the backlash is.
Point ProbeMove::contact_place(const ProbeReport& report, const Point& rest) const {
  MotorPosition motors = kinematics_.motors(start_, downs_);
  unsigned moved = 0;
  for (unsigned m = 0; m < kinematics_.motor_count(); ++m) {
    if (report.steps[m] == 0) continue;
    motors[m] = std::round(motors[m]) + report.steps[m];
    moved |= 1U << m;
  }
  AxisSet downs;
  for (const Axis axis : all_axes) {
    if (rest[axis] < start_[axis]) downs.add(axis);
  }
  return kinematics_.axes_after(start_, motors, moved, downs);
}

}  // namespace passo
