#include "passo/machine/virtual_spindle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {

void VirtualSpindle::command(Seconds time, double revolutions_per_minute) {
  turns_ = turns_at(time);
  speed_ = speed_at(time.value());
  commanded_at_ = time.value();
  target_ = revolutions_per_minute / 60 * (1 - model_.droop);
  const double rate = model_.run_up > 0 ? 1000.0 / 60 / model_.run_up : 0;
  ramp_ = rate > 0 ? std::abs(target_ - speed_) / rate : 0;
  rise_ = ramp_ > 0 ? (target_ - speed_) / ramp_ : 0;
}

double VirtualSpindle::speed_at(double time) const {
  const double since = time - commanded_at_;
  return since < ramp_ ? speed_ + rise_ * since : target_;
}

// The integral of (v + rise t) (1 + ripple sin(w t)), with t since time 0 in the sine and since `from` in the rise.
double VirtualSpindle::way(double from_speed, double rise, double from, double to) const {
  const double t = to - from;
  const double even = t * (from_speed + rise * t / 2);
  const double w = 2 * std::numbers::pi * model_.ripple_rate;
  if (!(w > 0) || model_.ripple == 0) return even;
  const auto wave = [&](double time) {
    return -(from_speed + rise * (time - from)) * std::cos(w * time) / w + rise * std::sin(w * time) / (w * w);
  };
  return even + model_.ripple * (wave(to) - wave(from));
}

double VirtualSpindle::turns_at(Seconds time) const {
  const double ramp_end = commanded_at_ + ramp_;
  const double t = time.value();
  double turns = turns_ + way(speed_, rise_, commanded_at_, std::min(t, ramp_end));
  if (t > ramp_end) turns += way(target_, 0, ramp_end, t);
  return turns;
}

SpindleReading VirtualSpindle::read(Seconds time) const {
  const double counts = model_.counts_per_turn;
  return {.time = time, .turns = std::floor(turns_at(time) * counts) / counts};
}

std::optional<Seconds> VirtualSpindle::next_index(Seconds after) const {
  if (target_ == 0) return std::nullopt;
  const double from = turns_at(after);
  const double aim = target_ > 0 ? std::floor(from) + 1 : std::ceil(from) - 1;
  const auto beyond = [&](double time) {
    return target_ > 0 ? turns_at(Seconds(time)) >= aim : turns_at(Seconds(time)) <= aim;
  };
  double low = after.value();
  double step = 0.1 / std::abs(target_);
  double high = low + step;
  // While it still turns the other way it takes longer.
  for (int i = 0; i < 100'000 && !beyond(high); ++i) {
    low = high;
    high += step;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (beyond(middle) ? high : low) = middle;
  }
  return Seconds(high);
}

}  // namespace passo
