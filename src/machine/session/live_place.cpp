// MachineSession: where the machine is while it moves, as its board tells.
#include <algorithm>

#include "work.hpp"

#include "passo/activity/stage_options.hpp"
#include "passo/geometry/euclid.hpp"
#include "passo/kinematics/kinematics.hpp"

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
  return kinematics_of(machine_).axes(place.exact(), downs, position_.place);
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
  const Point before = now_at_;
  const MotorPlace motors = steps_since(*zero_counts_, board_.status()->positions);
  now_at_ = kinematics_of(machine_).axes(motors, position_.downs, before);
  const Seconds since = board_.status_time() - place_heard_;
  place_heard_ = board_.status_time();
  speed_now_ = since > Seconds(0) ? Mm(distance(before, now_at_)) / since : speed_now_;
}

}  // namespace passo
