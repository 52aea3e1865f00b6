// MotionDrive: where the program waits for a person, and rests after each line.
#include <utility>

#include "passo/drive/motion_drive.hpp"

namespace passo {

void MotionDrive::wait_for_operator(const Action& action) {
  ++stops_;
  outputs_.take_over(action);
  script_.then([this] { feed_->switch_outputs(outputs_.tell()); });
  script_.until([this] { return feed_->settled(); });
  if (action.kind == Action::Kind::optional_stop && !waits_at_optional_) return;
  script_.then([this, action] {
    waits_for_ = action;
    holds_.add(action.kind == Action::Kind::tool_change ? HoldReason::tool_change : HoldReason::program_stop);
    rest_in_hold();
  });
}

// At rest before a thread that no encoder guides: the spindle turns as the program says when the thread begins.
void MotionDrive::hold_speed(const Action& action) {
  outputs_.heed_override(action.heeds.spindle_override);
  if (!outputs_.is_news()) return;
  const Seconds wait = spindle_run_up_ * (outputs_.change_of_speed() / 1000);
  script_.then([this] { feed_->switch_outputs(outputs_.tell()); });
  script_.until([this] { return feed_->settled(); });
  script_.then([this, wait] { pause_end_ = now() + wait; });
  await_pause_end();
}

void MotionDrive::done() {
  if (!waits_for_) return;
  const bool was_tool = waits_for_->kind == Action::Kind::tool_change;
  waits_for_.reset();
  resume(was_tool ? HoldReason::tool_change : HoldReason::program_stop);
}

void MotionDrive::stop_at_lines(bool wanted) {
  if (wanted == line_stops_.stops()) return;
  line_stops_.stop_at_lines(wanted);
  reads_again_ = false;
  if (!wanted || state_ == State::ended || stopped()) return;
  if (state_ == State::held) return feed_->read_again();
  reads_again_ = true;
  hold(HoldReason::line_end);
}

// The machine rests, and nobody has asked for that: a line has ended.
void MotionDrive::rest_at_line() {
  if (std::exchange(reads_again_, false)) feed_->read_again();
  if (line_stops_.stops() && !holds_.any_of(lasting_holds)) holds_.add(HoldReason::line_end);
}

}  // namespace passo
