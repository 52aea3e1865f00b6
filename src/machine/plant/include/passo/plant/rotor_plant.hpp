// RotorPlant: a plant whose motors obey physics. A motor that is asked for too much loses steps, and the plant tells
// when, which motor and how many.
//
// Each motor with a setup is a BoundedMotor, integrated in full where its bound does not hold. A motor without a setup
// does at once all that it is told, as in an ideal plant. Positions are the rotors' own, so switches and the probe act
// where the machine truly is.
//
// Invariant: time is the board's time. The same pulses at the same times give the same positions.
// Cost: docs/ramps/physics.md has a table. Nothing while the rotors rest.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "passo/motor/bounded_motor.hpp"
#include "passo/plant/encoder_drive.hpp"
#include "passo/plant/fitted_plant.hpp"

namespace passo {

// A motor has fallen out of step, or back.
struct StepLoss {
  Seconds time{0};
  std::size_t motor = 0;
  std::int64_t steps = 0;  // of the driver, lost by this event; negative: the rotor ran ahead
};

// Something holds a motor for a time, whichever way it turns.
struct Disturbance {
  std::size_t motor = 0;
  NewtonMetres torque = {};
  Seconds from{0};
  Seconds until{0};
};

// A drive with an encoder found the rotor too far from its commanded place.
struct FollowingFault {
  Seconds time{0};
  std::size_t motor = 0;
  double error = 0;  // steps of the driver; positive: the rotor was behind
};

// What one motor did in a run.
struct RotorRecord {
  std::int64_t lost = 0;  // steps of the driver; positive: the rotor stands too low
  double most_lag = 0;    // full steps from the rotor to the commanded place, either way; with an encoder as counted
  Seconds most_lag_at{0};
  double least_margin = 1;  // the share of the pull-out torque that was left; below 0: none
  Seconds least_margin_at{0};
};

class RotorPlant final : public FittedPlant {
 public:
  static constexpr std::size_t most_losses = 1000;  // that are kept one by one

  explicit RotorPlant(Integration integration = Integration::where_needed) : integration_(integration) {}

  // Gives a motor its physics, before a board drives the plant.
  void fit_motor(std::size_t motor, const MotorSetup& setup);
  // Gives that motor's drive an encoder, after fit_motor().
  void fit_encoder(std::size_t motor, const EncoderModel& model);
  // A torque of the work against the motion of a motor, from now on.
  void set_resistance(std::size_t motor, NewtonMetres torque);

  // The same from a time to another one. Takes effect at the first pulse or look then.
  void disturb(const Disturbance& disturbance);

  void pulse(Seconds time, const MotorSteps& steps) override;
  std::int64_t events_to_next_change() const override;
  std::uint16_t inputs_at(Seconds time) override;
  Truth truth_at(Seconds time) override;

  // Lets the rotors come to rest after the last pulse. Returns false if one still moves after `most`.
  bool settle(Seconds most);
  // Of the motor's driver. 0: the motor has no physics.
  int steps_per_full_step(std::size_t motor) const;
  const RotorRecord& record(std::size_t motor) const { return motors_[motor].record; }
  // The first following error beyond its limit. From then on the drive's alarm presses the board's emergency stop.
  const std::optional<FollowingFault>& following_fault() const { return following_fault_; }
  // The first losses, in the order of time.
  const std::vector<StepLoss>& losses() const { return losses_; }

 private:
  struct Fitted {
    std::optional<BoundedMotor> rotor;
    double origin = 0;     // of the rotor's place 0
    double full_step = 1;  // of a step of the driver
    std::optional<TorqueCurve> pull_out;
    Seconds margin_due{0};      // when the margin is looked at next
    double next_lag = 0;        // full steps; a lag up to here changes neither the record nor is_close_
    bool turns_freely = false;  // it has physics, and no drive with an encoder
    RotorRecord record;
    // Seldom looked at.
    std::optional<EncoderDrive> drive = {};  // with an encoder
    std::optional<MotorSetup> setup = {};
  };

  void run_to(Seconds time);
  Seconds pass_to(Seconds time);
  bool turn_freely(std::size_t motor, Seconds passed, int way);
  void turn(std::size_t motor, Seconds passed, std::int64_t steps);
  void apply_steps(std::size_t motor, Seconds passed, std::int64_t steps);
  void update_disturbances(Seconds time);
  void turn_with_encoder(std::size_t motor, Seconds passed, std::int64_t steps);
  void update_positions();
  void update_places();
  void update_lag(std::size_t motor, int stepped);
  void update_margin(Fitted& one) const;
  void record_loss(std::size_t motor);

  Integration integration_;
  std::array<Fitted, max_motors> motors_;
  MotorSteps untaken_{};  // that motors without physics have got since update_positions()
  std::vector<StepLoss> losses_;
  std::optional<FollowingFault> following_fault_;
  std::vector<Disturbance> disturbances_;
  std::vector<bool> disturbs_;          // which of them do now
  Seconds next_disturbance_{HUGE_VAL};  // when one begins or ends next
  Seconds now_{0};
  std::size_t fitted_ = 0;         // one more than the last motor that has physics
  bool is_close_ = true;           // every rotor that turned is close to where it was told to go
  std::int64_t quiet_pulses_ = 0;  // pulses until the switches must follow again
};

}  // namespace passo
