// ShaftEncoder: simulates an incremental encoder on a shaft. A position is only known in whole counts.
//
// Speed is the difference of two positions over one control period. One count more or less is a step of
// 2π/(counts·period), so the differences are smoothed: longer smoothing reduces the noise, but adds delay.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "passo/units/units.hpp"

namespace passo {

class ShaftEncoder {
 public:
  // `counts_per_turn`: all four edges of both channels, at least 4.
  explicit ShaftEncoder(int counts_per_turn) : per_radian_(counts_per_turn / (2 * std::numbers::pi)) {}

  std::int64_t counts_at(double radians) const { return std::llround(std::floor(radians * per_radian_)); }
  // Returns the middle of a count.
  double radians_of(std::int64_t counts) const { return (static_cast<double>(counts) + 0.5) / per_radian_; }
  double radians_per_count() const { return 1 / per_radian_; }

 private:
  double per_radian_;
};

// The speed of a shaft, computed from its encoder's counts.
class CountedSpeed {
 public:
  // `smoothing`: time constant of the filter; 0: none.
  CountedSpeed(const ShaftEncoder& encoder, Seconds period, Seconds smoothing)
      : per_count_(encoder.radians_per_count() / period.value()),
        share_(period.value() / (period.value() + smoothing.value())) {}

  // Must be called once per period. The first counts are taken as those of a stopped shaft.
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
