// MachineSession: where the machine is while it moves, as its board tells.
#include <algorithm>

#include "work.hpp"

#include "passo/activity/stage_options.hpp"
#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// How often a board is asked where it is. Over a line, each question takes time of the line.
constexpr Seconds between_places{0.016};
constexpr Seconds between_places_over_a_line{0.05};

}  // namespace

std::optional<Refusal> MachineSession::lost_place() const {
  if (!options_.needs_place || position_.trust != Trust::unknown) return {};
  const bool homes_all_axes = machine_.homing.size() == machine_.axes.size();
  if (!homes_all_axes && !position_.is_lost) return {};
  return Refusal{.code = RefusalCode::place_unknown,
                 .message = homes_all_axes
                                ? "where the machine stands is not known: home it first"
                                : "where the machine stands is not known: jog it to a known place, and confirm it"};
}

Point MachineSession::place_of(const BoardPlace& place, AxisSet downs) const {
  Point point = position_.place;
  const StepOptions steps = passo::step_options(machine_);
  for (std::size_t m = 0; m < machine_.axes.size(); ++m) {
    const double exact = static_cast<double>(place.motors[m]) / whole_step - 0.5;
    const Motor& motor = steps.motors[m];
    point[motor.axis] = motor.place_at(exact, downs.has(motor.axis));
  }
  return point;
}

// Asks the board where it is, and takes over what it has told.
void MachineSession::look_at_place() {
  if (!options_.tells_place) return;
  if (!busy()) {
    now_at_ = position_.place;
    speed_now_ = MmPerSecond(0);
    return;
  }
  // At rest the drive knows the place itself: a question of before the rest may be answered after the rest.
  const bool rests = work_->drive && work_->drive->state() == MotionDrive::State::held;
  if (rests) {
    now_at_ = place_of(work_->drive->place(), work_->drive->downs());
    speed_now_ = MmPerSecond(0);
  }
  if (board_.error() || !zero_counts_) return;
  if (!rests && board_.status() && board_.status_time() != place_heard_) hear_place();
  const Seconds between = options_.over_a_line ? between_places_over_a_line : between_places;
  // Whoever asked last: a board has little time to answer amid dense motion.
  const Seconds asked = board_.status() ? std::max(place_asked_, board_.status_time()) : place_asked_;
  if (work_->finishing || !board_.settled() || now() - asked < between) return;
  place_asked_ = now();
  board_.ask();
}

void MachineSession::hear_place() {
  const StepOptions steps = passo::step_options(machine_);
  const Point before = now_at_;
  for (std::size_t m = 0; m < machine_.axes.size(); ++m) {
    const auto counted = static_cast<double>(std::int64_t{board_.status()->positions[m]} - (*zero_counts_)[m]);
    const Motor& motor = steps.motors[m];
    now_at_[motor.axis] = motor.place_at(counted, position_.downs.has(motor.axis));
  }
  const Seconds since = board_.status_time() - place_heard_;
  place_heard_ = board_.status_time();
  speed_now_ = since > Seconds(0) ? Mm(distance(before, now_at_)) / since : speed_now_;
}

}  // namespace passo
