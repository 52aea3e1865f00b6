// SpindleRunUp: tells when a spindle has reached its speed: when a turn takes as long as ordered, or nearly as long as
// the turn before. From then on the spindle counts as at speed until the next begin().
#pragma once

#include "passo/drive/spindle_encoder.hpp"

namespace passo {

class SpindleRunUp {
 public:
  void begin(double revolutions_per_minute);
  void read(const SpindleReading& now);
  bool at_speed() const { return at_speed_; }

 private:
  double wanted_ = 0;  // seconds a turn
  SpindleReading turn_begun_;
  double turn_before_ = 0;  // seconds
  int turns_ = 0;
  bool at_speed_ = false;
};

}  // namespace passo
