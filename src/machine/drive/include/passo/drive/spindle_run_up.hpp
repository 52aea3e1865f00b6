// SpindleRunUp: detects when a spindle has reached its speed: a revolution takes the commanded time, or nearly the time
// of the previous one. From then on the spindle counts as at speed until the next begin().
#pragma once

#include "passo/drive/spindle_encoder.hpp"

namespace passo {

class SpindleRunUp {
 public:
  void begin(double revolutions_per_minute);
  void read(const SpindleReading& now);
  bool at_speed() const { return at_speed_; }

 private:
  double wanted_ = 0;  // seconds per revolution
  SpindleReading turn_begun_;
  double turn_before_ = 0;  // seconds
  int turns_ = 0;
  bool at_speed_ = false;
};

}  // namespace passo
