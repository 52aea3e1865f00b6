// ShaftEncoder: what an incremental encoder on a shaft tells. A place is only known in whole counts.
//
// Speed is the difference of two places, over one period of the control. One count more or less is a jump of
// 2π/(counts·period), so the differences are smoothed: a longer smoothing has less noise, and is later.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "passo/units/units.hpp"

namespace passo {

class ShaftEncoder {
 public:
  // `counts_per_turn`: all four edges of both tracks, 4 or more.
  explicit ShaftEncoder(int counts_per_turn) : per_radian_(counts_per_turn / (2 * std::numbers::pi)) {}

  std::int64_t counts_at(double radians) const { return std::llround(std::floor(radians * per_radian_)); }
  // The middle of a count.
  double radians_of(std::int64_t counts) const { return (static_cast<double>(counts) + 0.5) / per_radian_; }
  double radians_per_count() const { return 1 / per_radian_; }

 private:
  double per_radian_;
};

// The speed of a shaft from its encoder's counts.
class CountedSpeed {
 public:
  // `smoothing`: the time constant of the mean; 0: none.
  CountedSpeed(const ShaftEncoder& encoder, Seconds period, Seconds smoothing)
      : per_count_(encoder.radians_per_count() / period.value()),
        share_(period.value() / (period.value() + smoothing.value())) {}

  // Once in each period. The first counts are those of a shaft that rests.
  double update(std::int64_t counts) {
    if (!begun_) last_ = counts;
    begun_ = true;
    const double now = static_cast<double>(counts - last_) * per_count_;
    last_ = counts;
    speed_ += share_ * (now - speed_);
    return speed_;
  }

 private:
  double per_count_;
  double share_;
  std::int64_t last_ = 0;
  double speed_ = 0;  // rad/s
  bool begun_ = false;
};

}  // namespace passo
