// RotorPlant: a plant whose motors obey physics. An overloaded motor loses steps, and the plant reports the time, the
// motor and the number.
//
// Each motor with a setup is a BoundedMotor, fully integrated where its bound does not hold. A motor without a setup
// follows every pulse immediately, as in an ideal plant. Positions are the rotors' own, so switches and the probe act
// at the true positions.
//
// Invariant: time is the board's time. The same pulses at the same times give the same positions. Cost:
// docs/ramps/physics.md has a table. It is zero while the rotors are at rest.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "passo/motor/bounded_motor.hpp"
#include "passo/plant/encoder_drive.hpp"
#include "passo/plant/fitted_plant.hpp"

namespace passo {

// A motor has lost synchronism, or regained it.
struct StepLoss {
  Seconds time{0};
  std::size_t motor = 0;
  std::int64_t steps = 0;  // driver steps lost by this event; negative: the rotor ran ahead
};

// A load torque against a motor's motion in either direction, for a limited time.
struct Disturbance {
  std::size_t motor = 0;
  NewtonMetres torque = {};
  Seconds from{0};
  Seconds until{0};
};

// A drive with an encoder measured a following error beyond its limit.
struct FollowingFault {
  Seconds time{0};
  std::size_t motor = 0;
  double error = 0;  // driver steps; positive: the rotor was behind
};

// The statistics of one motor in a run.
struct RotorRecord {
  std::int64_t lost = 0;  // driver steps; positive: the rotor is too low
  double most_lag = 0;    // full steps from the rotor to the commanded position, either way; with an encoder as counted
  Seconds most_lag_at{0};
  double least_margin = 1;  // the fraction of the pull-out torque that was left; negative: none
  Seconds least_margin_at{0};
};

class RotorPlant final : public FittedPlant {
 public:
  static constexpr std::size_t most_losses = 1000;  // number of losses that are recorded individually

  explicit RotorPlant(Integration integration = Integration::where_needed) : integration_(integration) {}

  // Adds a motor's physics, before a board drives the plant.
  void fit_motor(std::size_t motor, const MotorSetup& setup);
  // Adds an encoder to that motor's drive, after fit_motor().
  void fit_encoder(std::size_t motor, const EncoderModel& model);
  // Sets a torque against the motion of a motor, from now on.
  void set_resistance(std::size_t motor, NewtonMetres torque);

  // The same during a time interval. Takes effect at the first pulse or sample after its start.
  void disturb(const Disturbance& disturbance);

  void pulse(Seconds time, const MotorSteps& steps) override;
  std::int64_t events_to_next_change() const override;
  std::uint16_t inputs_at(Seconds time) override;
  Truth truth_at(Seconds time) override;

  // Lets the rotors settle after the last pulse. Returns false if one still moves after `most`.
  bool settle(Seconds most);
  // The microsteps per full step of the motor's driver. 0: the motor has no physics.
  int steps_per_full_step(std::size_t motor) const;
  const RotorRecord& record(std::size_t motor) const { return motors_[motor].record; }
  // The first following error beyond its limit. From then on the drive's alarm triggers the board's emergency stop.
  const std::optional<FollowingFault>& following_fault() const { return following_fault_; }
  // The first step losses, in the order of time.
  const std::vector<StepLoss>& losses() const { return losses_; }

 private:
  struct Fitted {
    std::optional<BoundedMotor> rotor;
    double origin = 0;     // at the rotor's position 0
    double full_step = 1;  // in driver steps
    std::optional<TorqueCurve> pull_out;
    Seconds margin_due{0};      // time of the next check of the margin
    double next_lag = 0;        // full steps; a lag up to here changes neither the record nor is_close_
    bool turns_freely = false;  // it has physics, but no drive with an encoder
    RotorRecord record;
    // Rarely used members.
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
  MotorSteps untaken_{};  // pulses of motors without physics since update_positions()
  std::vector<StepLoss> losses_;
  std::optional<FollowingFault> following_fault_;
  std::vector<Disturbance> disturbances_;
  std::vector<bool> disturbs_;          // which disturbances are active
  Seconds next_disturbance_{HUGE_VAL};  // time of the next start or end of a disturbance
  Seconds now_{0};
  std::size_t fitted_ = 0;         // one more than the index of the last motor with physics
  bool is_close_ = true;           // every rotor that turned is close to its commanded position
  std::int64_t quiet_pulses_ = 0;  // pulses until the switches must be updated
};

}  // namespace passo
