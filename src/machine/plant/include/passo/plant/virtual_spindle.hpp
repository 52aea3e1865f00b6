// VirtualSpindle: a spindle with an encoder that runs up, droops under load and ripples, like a real spindle.
//
// The angle is known at every time in closed form, so the same commands give the same angles. After a command the speed
// changes at a constant rate to the commanded speed minus the droop. The ripple is added as a fraction of the speed.
#pragma once

#include <cstdint>

#include "passo/units/units.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct SpindleModel {
  std::int32_t counts_per_turn = 0;  // of the encoder; 0: there is no encoder
  double run_up = 0;                 // seconds from standstill to 1000 rpm; 0: immediately
  double droop = 0;                  // the fraction by which the speed is below the commanded one
  double ripple = 0;                 // amplitude of the speed variation, as a fraction
  double ripple_rate = 0;            // ripples per second
};

class VirtualSpindle {
 public:
  VirtualSpindle() = default;
  explicit VirtualSpindle(const SpindleModel& model) : model_(model) {}

  // Sets the speed from `time` on. Negative: reverse.
  void command(Seconds time, double revolutions_per_minute);

  // Returns the exact revolutions since the start, not rounded to the encoder's counts.
  double turns_at(Seconds time) const;
  bool has_encoder() const { return model_.counts_per_turn > 0; }
  std::int32_t counts_per_turn() const { return model_.counts_per_turn; }
  const SpindleModel& model() const { return model_; }
  // Returns the encoder's count, and its count at the last index. The index is at whole revolutions, in the commanded
  // direction. The tick is not set.
  SpindleCount count_at(Seconds time) const;

 private:
  double speed_at(double time) const;  // rev/s after the last command, without the ripple
  double way(double from_speed, double rise, double from, double to) const;

  SpindleModel model_;
  double commanded_at_ = 0;
  double turns_ = 0;   // at the last command
  double speed_ = 0;   // at the last command
  double target_ = 0;  // less the droop
  double rise_ = 0;    // rev/s²
  double ramp_ = 0;    // time until the target speed is reached, in seconds
};

}  // namespace passo
