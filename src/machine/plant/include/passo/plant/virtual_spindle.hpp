// VirtualSpindle: a spindle with an encoder that runs up, droops under load and ripples, as a real spindle does.
//
// The angle is known at every time in closed form, so the same commands give the same angles. After a command the speed
// goes at an even rate to the commanded speed minus the droop. The ripple is added to that, as a part of the speed.
#pragma once

#include <cstdint>

#include "passo/units/units.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct SpindleModel {
  std::int32_t counts_per_turn = 0;  // of the encoder; 0: there is no encoder
  double run_up = 0;                 // seconds from standstill to 1000 rpm; 0: immediately
  double droop = 0;                  // the part of the commanded speed that is missing
  double ripple = 0;                 // the part of the speed by which the speed goes up and down
  double ripple_rate = 0;            // ripples a second
};

class VirtualSpindle {
 public:
  VirtualSpindle() = default;
  explicit VirtualSpindle(const SpindleModel& model) : model_(model) {}

  // Sets the speed from `time` on. Negative: the other way round.
  void command(Seconds time, double revolutions_per_minute);

  // Exact turns since the start, not rounded to the encoder's counts.
  double turns_at(Seconds time) const;
  bool has_encoder() const { return model_.counts_per_turn > 0; }
  std::int32_t counts_per_turn() const { return model_.counts_per_turn; }
  const SpindleModel& model() const { return model_; }
  // What the encoder has counted, and its count at the last index. The index is where the turns are a whole number, in
  // the commanded direction. The tick is not set.
  SpindleCount count_at(Seconds time) const;

 private:
  double speed_at(double time) const;  // turns a second after the last command, without the ripple
  double way(double from_speed, double rise, double from, double to) const;

  SpindleModel model_;
  double commanded_at_ = 0;
  double turns_ = 0;   // then
  double speed_ = 0;   // then
  double target_ = 0;  // minus the droop
  double rise_ = 0;    // turns a second, a second
  double ramp_ = 0;    // seconds to reach the target
};

}  // namespace passo
