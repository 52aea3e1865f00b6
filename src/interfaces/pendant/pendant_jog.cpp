#include "passo/pendant/pendant_jog.hpp"

#include <algorithm>
#include <cmath>

namespace passo {

const AxisDescription* PendantJog::selected() const {
  const auto found = axis_ ? std::ranges::find(machine_.axes, *axis_, &AxisDescription::axis) : machine_.axes.end();
  return found != machine_.axes.end() ? &*found : nullptr;
}

void PendantJog::select(std::optional<Axis> axis) {
  if (axis == axis_) return;
  end();
  axis_ = axis;
}

void PendantJog::drop() {
  waiting_ = 0;
  held_.reset();
  by_ring_ = false;
}

void PendantJog::end() {
  drop();
  if (!current_ || brakes_) return;
  brakes_ = true;
  port_.stop();
}

double PendantJog::left_of_jog(Seconds now) const {
  if (!current_ || current_->distance == 0) return 0;
  return std::max(0.0, current_->distance - current_->speed.value() * current_->share * (now - begun_at_).value());
}

void PendantJog::step(int detents, double step, double share, Seconds now) {
  const AxisDescription* const axis = selected();
  turned_at_ = now;
  if (axis == nullptr || detents == 0 || !(step > 0) || held_ || brakes_) return;
  const double most = std::max(step, axis->velocity.value() * share * most_behind.value());
  // Whole steps only: the machine stays on the grid of the wheel.
  const double room = std::floor(std::max(0.0, most - left_of_jog(now)) / step + 1e-9) * step;
  waiting_ = std::clamp(waiting_ + detents * step, -room, room);
  step_share_ = share;
}

void PendantJog::turn(int detents, double share, Seconds now) {
  const AxisDescription* const axis = selected();
  turned_at_ = now;
  if (axis == nullptr || detents == 0 || by_ring_) return;
  held_ = PendantMove{.axis = axis->axis, .sign = detents > 0 ? 1 : -1, .speed = axis->velocity, .share = share};
}

void PendantJog::hold_ring(int sign, double share) {
  const AxisDescription* const axis = selected();
  by_ring_ = sign != 0 && axis != nullptr;
  held_.reset();
  if (!by_ring_) return;
  held_ = PendantMove{.axis = axis->axis, .sign = sign, .speed = axis->velocity, .share = share};
  waiting_ = 0;
}

// A jog that ended by itself, at the end of the travel, does not begin again.
void PendantJog::watch_end() {
  if (!current_ || port_.jogs()) return;
  if (!brakes_ && current_->distance == 0) barred_ = current_;
  current_.reset();
  brakes_ = false;
}

void PendantJog::watch_pause(Seconds now) {
  if (by_ring_ || now - turned_at_ <= pause_) return;
  held_.reset();
  barred_.reset();
}

void PendantJog::keep_going(Seconds now) {
  const bool is_step = current_->distance > 0;
  const bool lasts = is_step || (held_ && held_->is_same_way(*current_));
  if (brakes_) return;
  if (!lasts) {
    brakes_ = true;
    return port_.stop();
  }
  const double share = is_step ? current_->share : held_->share;
  if (share == current_->share && now - renewed_at_ < renews_every) return;
  current_->share = share;
  renewed_at_ = now;
  port_.renew(share);
}

void PendantJog::begin_next(Seconds now) {
  const AxisDescription* const axis = selected();
  PendantMove next;
  if (held_ && !(barred_ && barred_->is_same_way(*held_))) {
    next = *held_;
  } else if (waiting_ != 0 && axis != nullptr) {
    next = {.axis = axis->axis,
            .sign = waiting_ > 0 ? 1 : -1,
            .speed = axis->velocity,
            .share = step_share_,
            .distance = std::abs(waiting_)};
  } else {
    return;
  }
  waiting_ = 0;
  if (!port_.begin(next)) {
    barred_ = next;
    return;
  }
  current_ = next;
  begun_at_ = renewed_at_ = now;
}

void PendantJog::poll(Seconds now) {
  watch_end();
  watch_pause(now);
  if (current_) {
    keep_going(now);
  } else {
    begin_next(now);
  }
}

}  // namespace passo
