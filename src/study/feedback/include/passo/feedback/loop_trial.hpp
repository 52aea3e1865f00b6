// Loop trials: the step response of a motor with an encoder and a controller.
//
//   speed      set speed ─►(−)─► PID ─► torque ─► motor ─► encoder ─┐
//                           └──────────── measured speed ◄──────────┤
//   position   set position ─►(−)─► PID ─► set speed ─► the loop above, with separate gains
//                              └─────────── measured position ◄─────┘
//
// Each trial begins at standstill, and the same setup gives the same numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/feedback/pid.hpp"
#include "passo/feedback/servo_motor.hpp"

namespace passo {

enum class Controlled : std::uint8_t { speed, position };

struct LoopSetup {
  MotorSetup motor;
  int counts_per_turn = 4000;
  Seconds period{0.0001};
  Seconds smoothing{0.0005};  // smoothing of the measured speed
  Controlled controlled = Controlled::speed;
  PidGains gains = {};            // N·m per rad/s; for a position loop: rad/s per radian
  PidGains speed_gains = {};      // for the inner loop of a position loop
  double to = 0;                  // rad/s or radians
  RadiansPerSecond fastest{200};  // maximum set speed of a position loop's inner loop
  NewtonMetres load = {};         // load torque against the motion, starting at `load_at`
  Seconds load_at{0};
};

struct LoopMoment {
  Seconds time{0};
  double wanted = 0;
  double counted = 0;  // value measured by the encoder
  double is = 0;       // actual value
  RadiansPerSecond speed = {};
  NewtonMetres asked = {};  // torque demanded from the motor
  NewtonMetres torque = {};
};

// Returns one moment for each control period.
std::vector<LoopMoment> step_response(const LoopSetup& setup, Seconds whole);

struct LoopFigures {
  std::optional<Seconds> rise = {};     // from 10 % to 90 %
  double overshoot = 0;                 // fraction of the step
  std::optional<Seconds> settled = {};  // from then on within 5 % of the step
  double error = 0;                     // at the end: mean of the last tenth of the time
  double swing = 0;                     // at the end: difference of the maximum and minimum there
};

// Evaluates the response before the load is applied, if there is one.
LoopFigures figures_of(const std::vector<LoopMoment>& moments, const LoopSetup& setup);

// Returns the gain at which the loop with P only oscillates with constant amplitude, found by trials. Empty: the loop
// does not oscillate at any gain that the motor's torque allows.
std::optional<UltimateCycle> ultimate_cycle(const LoopSetup& setup);

}  // namespace passo
