// VirtualSpindle: a spindle that runs up, droops under load and ripples, as a real one does, with an encoder.
//
// Its angle is known at every time in closed form, so that the same commands give the same angles. Between a command
// and the next the speed goes to what was commanded, less the droop, at an even rate; the ripple is a part of it.
#pragma once

#include <cstdint>

#include "passo/units/units.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct SpindleModel {
  std::int32_t counts_per_turn = 0;  // of the encoder; 0: there is none
  double run_up = 0;                 // seconds from rest to 1000 revolutions a minute; 0: at once
  double droop = 0;                  // part of the commanded speed that is missing
  double ripple = 0;                 // part of the speed by which it goes up and down
  double ripple_rate = 0;            // how often a second
};

class VirtualSpindle {
 public:
  VirtualSpindle() = default;
  explicit VirtualSpindle(const SpindleModel& model) : model_(model) {}

  // Revolutions a minute, below 0 the other way, from that time on.
  void command(Seconds time, double revolutions_per_minute);

  // Turns since the start, without the encoder's steps.
  double turns_at(Seconds time) const;
  bool has_encoder() const { return model_.counts_per_turn > 0; }
  std::int32_t counts_per_turn() const { return model_.counts_per_turn; }
  // What it has counted, and at the last index: where the turns were a whole number, the way that it was commanded.
  // Without the tick.
  SpindleCount count_at(Seconds time) const;

 private:
  double speed_at(double time) const;  // turns a second since the last command, without the ripple
  double way(double from_speed, double rise, double from, double to) const;

  SpindleModel model_;
  double commanded_at_ = 0;
  double turns_ = 0;   // then
  double speed_ = 0;   // then
  double target_ = 0;  // less the droop
  double rise_ = 0;    // turns a second, a second
  double ramp_ = 0;    // how long it takes to the target
};

}  // namespace passo
