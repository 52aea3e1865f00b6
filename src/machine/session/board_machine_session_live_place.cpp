// BoardMachineSession: where the machine is while it moves, as its board tells.
#include <optional>

#include "work.hpp"

#include "passo/activity/stage_options.hpp"
#include "passo/kinematics/kinematics.hpp"

namespace passo {
namespace {

// How often a board is asked where it is. Over a line, each question takes time of the line.
constexpr Seconds between_places{0.016};
constexpr Seconds between_places_over_a_line{0.05};

}  // namespace

std::optional<Refusal> BoardMachineSession::lost_place() const {
  if (!options_.needs_place || position().trust != Trust::unknown) return {};
  const bool homes_all_axes = machine_.homing.size() == machine_.axes.size();
  if (!homes_all_axes && !position().is_lost) return {};
  return Refusal{homes_all_axes ? RefusalReason::unknown_so_home : RefusalReason::unknown_so_jog};
}

// Asks the board where it is, and takes over what it has told.
void BoardMachineSession::poll_place() {
  if (!options_.tells_place) return;
  if (!busy()) return live_position_.rest_at(position().place);
  // At rest the drive knows the place itself: a question of before the rest may be answered after the rest.
  const bool rests = work_->drive && work_->drive->state() == MotionDrive::State::held;
  if (rests) live_position_.rest_at(place_.point_of(work_->drive->place(), work_->drive->downs()));
  if (board_.error() || !zero_counts()) return;
  const auto heard = board_.status() ? std::optional(board_.status_time()) : std::nullopt;
  if (!rests && heard && live_position_.is_news(*heard)) {
    const MotorPosition motors = steps_since(*zero_counts(), board_.status()->positions);
    live_position_.hear(kinematics_of(machine_).axes(motors, position().downs, live_position_.at()), *heard);
  }
  const Seconds between = options_.over_a_line ? between_places_over_a_line : between_places;
  const bool is_asked = work_->stage == Work::Stage::asks_counts;
  if (is_asked || !board_.settled() || !live_position_.is_due(now(), heard, between)) return;
  live_position_.on_asked(now());
  board_.ask();
}

}  // namespace passo
