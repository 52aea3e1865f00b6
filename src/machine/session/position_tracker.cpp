#include "passo/session/position_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/kinematics/kinematics.hpp"

namespace passo {

void PositionTracker::stand_at(const KnownPosition& position, const BoardStatus* board) {
  position_ = position;
  trust_before_ = position.trust;
  lost_before_ = position.is_lost;
  mismatch_.reset();
  if (on_board_) {
    const MotorSteps steps = steps_at(machine_, position.place, position.downs);
    for (std::size_t m = 0; m < machine_.axes.size(); ++m) on_board_->set_steps(m, steps[m]);
  }
  count_from_here(board);
}

void PositionTracker::count_from_here(const BoardStatus* board) {
  if (board == nullptr) return;
  const MotorSteps steps = on_board_ ? steps_of(*on_board_) : steps_at(machine_, position_.place, position_.downs);
  zero_counts_.emplace();
  for (std::size_t m = 0; m < machine_.axes.size(); ++m) {
    (*zero_counts_)[m] = std::int64_t{board->positions[m]} - steps[m];
  }
}

MotorSteps PositionTracker::steps_of(const BoardPosition& place) const {
  MotorSteps steps{};
  for (std::size_t m = 0; m < machine_.axes.size(); ++m) steps[m] = place.steps(m);
  return steps;
}

void PositionTracker::doubt() {
  if (position_.trust != Trust::unknown) trust_before_ = position_.trust;
  if (!position_.is_lost) lost_before_ = false;
  position_.trust = Trust::unknown;
  position_.is_lost = true;
}

void PositionTracker::find_again(const BoardStatus& board, bool has_counted) {
  on_board_.reset();
  if (!has_counted || !zero_counts_) {
    trust_before_ = Trust::unknown;
    return;
  }
  position_.trust = trust_before_;
  position_.is_lost = lost_before_;
  const MotorPosition motors = steps_since(*zero_counts_, board.positions);
  position_.place = kinematics_of(machine_).axes(motors, position_.downs, position_.place);
}

void PositionTracker::rest_at(const BoardPosition& place, AxisSet downs) {
  on_board_ = place;
  position_.downs = downs;
  position_.place = point_of(place, downs);
}

bool PositionTracker::agrees_with(const BoardStatus* board) {
  if (board == nullptr || !zero_counts_) return true;
  for (std::size_t m = 0; m < machine_.axes.size(); ++m) {
    const std::int64_t counted = std::int64_t{board->positions[m]} - (*zero_counts_)[m];
    if (counted == on_board_->steps(m)) continue;
    mismatch_ = CountMismatch{.motor = m, .counted = counted, .commanded = on_board_->steps(m)};
    position_.trust = Trust::unknown;
    position_.is_lost = true;
    count_from_here(board);
    return false;
  }
  if (position_.trust == Trust::commanded) position_.trust = Trust::counted;
  return true;
}

// A machine of which some axes have no switches is homed only from a known place.
void PositionTracker::home(const std::vector<HomedAxis>& homed, const BoardStatus* board) {
  for (const HomedAxis& one : homed) position_.place[one.axis] = one.place;
  const Kinematics kinematics = kinematics_of(machine_);
  for (std::size_t m = 0; m < kinematics.rows().size(); ++m) {
    const MotorRow& motor = kinematics.rows()[m];
    const bool is_homed =
        std::ranges::any_of(homed, [&](const HomedAxis& one) { return motor.steps.factor_of(one.axis) != 0; });
    if (is_homed) on_board_->set_steps(m, std::llround(motor.steps_at(position_.place, position_.downs)));
  }
  if (position_.trust != Trust::unknown || machine_.homing.size() == machine_.axes.size()) {
    position_.trust = Trust::homed;
    position_.is_lost = false;
  }
  mismatch_.reset();
  count_from_here(board);
}

Point PositionTracker::point_of(const BoardPosition& place, AxisSet downs) const {
  return kinematics_of(machine_).axes(place.exact(), downs, position_.place);
}

}  // namespace passo
