// RotorPlant: a plant whose motors obey physics. A motor that is asked for too much loses steps, and the plant tells
// when, which motor and how many.
//
// Each motor with a setup is a RunningMotor, integrated from pulse to pulse. A motor without a setup does at once all
// that it is told, as in an ideal plant. Positions are the rotors' own, so switches and the probe act where the machine
// truly is.
//
// Invariant: time is the board's time. The same pulses at the same times give the same positions.
// Cost: about 25 ns for each 25 µs and motor while a rotor moves; nothing while the rotors rest.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "passo/motor/running_motor.hpp"
#include "passo/plant/fitted_plant.hpp"

namespace passo {

// A motor has fallen out of step, or back.
struct StepLoss {
  Seconds time{0};
  std::size_t motor = 0;
  std::int64_t steps = 0;  // of the driver, lost by this event; negative: the rotor ran ahead
};

// What one motor did in a run.
struct RotorRecord {
  std::int64_t lost = 0;  // steps of the driver; positive: the rotor stands too low
  double most_lag = 0;    // full steps from the rotor to the commanded place, either way
  Seconds most_lag_at{0};
  double least_margin = 1;  // the share of the pull-out torque that was left; below 0: none
  Seconds least_margin_at{0};
};

class RotorPlant final : public FittedPlant {
 public:
  static constexpr std::size_t most_losses = 1000;  // that are kept one by one

  // Gives a motor its physics, before a board drives the plant.
  void fit_motor(std::size_t motor, const MotorSetup& setup);
  // A torque of the work against the motion of a motor, from now on.
  void set_resistance(std::size_t motor, NewtonMetres torque);

  void pulse(Seconds time, const MotorSteps& steps) override;
  std::int64_t events_to_next_change() const override;
  std::uint16_t inputs_at(Seconds time) override;
  Truth truth_at(Seconds time) override;

  // Lets the rotors come to rest after the last pulse. Returns false if one still moves after `most`.
  bool settle(Seconds most);
  // Of the motor's driver. 0: the motor has no physics.
  int steps_per_full_step(std::size_t motor) const;
  const RotorRecord& record(std::size_t motor) const { return motors_[motor].record; }
  // The first losses, in the order of time.
  const std::vector<StepLoss>& losses() const { return losses_; }

 private:
  struct Fitted {
    std::optional<RunningMotor> rotor;
    double origin = 0;  // of the rotor's place 0
    std::optional<TorqueCurve> pull_out;
    RotorRecord record;
  };

  void run_to(Seconds time);
  void look_at(std::size_t motor);

  std::array<Fitted, max_motors> motors_;
  std::vector<StepLoss> losses_;
  Seconds now_{0};
  bool any_ = false;
};

}  // namespace passo
