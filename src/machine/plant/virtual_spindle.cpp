#include "passo/plant/virtual_spindle.hpp"

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

SpindleCount VirtualSpindle::count_at(Seconds time) const {
  const double turns = turns_at(time);
  const double last = target_ < 0 ? std::ceil(turns) : std::floor(turns);
  const auto modulo = [](double counts) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(counts)); };
  return {.count = modulo(std::floor(turns * model_.counts_per_turn)),
          .at_index = modulo(last * model_.counts_per_turn),
          .indexes = static_cast<std::uint8_t>(modulo(std::abs(last)))};
}

}  // namespace passo
