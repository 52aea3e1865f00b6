// RotorCrowd: a plant in which several motors of different strength get the pulses of each motor. One run of a program
// tells which of them lose steps.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "passo/motor/running_motor.hpp"
#include "passo/plant/fitted_plant.hpp"

namespace passo::test {

class RotorCrowd final : public FittedPlant {
 public:
  // The motors of the next axis.
  void add_axis(const std::vector<MotorSetup>& setups) {
    for (const MotorSetup& setup : setups) members_.push_back({.axis = axes_, .rotor = RunningMotor(setup)});
    ++axes_;
  }
  // Whether the `which`-th motor of an axis has lost steps.
  bool lost(std::size_t axis, std::size_t which) const { return nth(axis, which).lost; }

  void pulse(Seconds time, const MotorSteps& steps) override {
    run_to(time);
    for (Member& member : members_) {
      const int way = steps[member.axis] > 0 ? 1 : -1;
      for (std::int64_t left = std::abs(steps[member.axis]); left > 0 && !member.lost; --left) member.rotor.step(way);
      member.lost = member.lost || member.rotor.slipped() != 0;
    }
    for (std::size_t m = 0; m < axes_; ++m) moving_positions()[m] += static_cast<double>(steps[m]);
  }
  std::int64_t events_to_next_change() const override { return 1; }
  std::uint16_t inputs_at(Seconds time) override {
    run_to(time);
    return switches().closed();
  }
  Truth truth_at(Seconds time) override {
    run_to(time);
    return {.positions = slides(), .spindle_turns = spindle().turns_at(time), .inputs = switches().closed()};
  }
  void settle(Seconds time) { run_to(now_ + time); }

 private:
  struct Member {
    std::size_t axis = 0;
    RunningMotor rotor;
    bool lost = false;  // and left out from then on
  };

  const Member& nth(std::size_t axis, std::size_t which) const {
    std::size_t i = 0;
    while (members_[i].axis != axis) ++i;
    return members_[i + which];
  }
  void run_to(Seconds time) {
    if (time <= now_) return;
    for (Member& member : members_) {
      if (member.lost) continue;
      member.rotor.run(time - now_);
      member.lost = member.rotor.slipped() != 0;
    }
    now_ = time;
  }

  std::vector<Member> members_;
  std::size_t axes_ = 0;
  Seconds now_{0};
};

}  // namespace passo::test
