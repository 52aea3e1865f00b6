// MotionDrive: where the program waits for a person, and rests after each line.
#include <utility>

#include "passo/drive/motion_drive.hpp"

namespace passo {

void MotionDrive::wait_for_operator(const Action& action) {
  ++stops_;
  outputs_.apply(action);
  switching_.switch_as_ordered();
  if (action.kind == Action::Kind::optional_stop && !waits_at_optional_) return;
  script_.then([this, action] {
    waits_for_ = action;
    holds_.set(action.kind == Action::Kind::tool_change ? HoldReason::tool_change : HoldReason::program_stop);
    stop_in_hold();
  });
}

void MotionDrive::done() {
  if (!waits_for_) return;
  const bool was_tool = waits_for_->kind == Action::Kind::tool_change;
  waits_for_.reset();
  resume(was_tool ? HoldReason::tool_change : HoldReason::program_stop);
}

void MotionDrive::stop_at_lines(bool wanted) {
  if (wanted == pipeline_.line_stops().stops()) return;
  pipeline_.line_stops().stop_at_lines(wanted);
  reads_again_ = false;
  if (!wanted || state_ == State::ended || stopped()) return;
  if (state_ == State::held) return feed_->read_again();
  reads_again_ = true;
  hold(HoldReason::line_end);
}

// The machine rests, and nobody has asked for that: a line has ended.
void MotionDrive::rest_at_line() {
  if (std::exchange(reads_again_, false)) feed_->read_again();
  if (pipeline_.line_stops().stops() && !holds_.any_of(lasting_holds)) holds_.set(HoldReason::line_end);
}

}  // namespace passo
