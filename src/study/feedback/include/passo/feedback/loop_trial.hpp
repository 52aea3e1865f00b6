// Loop trials: what a motor with an encoder and a controller does when the wanted value jumps.
//
//   speed      wanted speed ─►(−)─► PID ─► torque ─► motor ─► encoder ─┐
//                              └──────────── counted speed ◄───────────┤
//   position   wanted place ─►(−)─► PID ─► wanted speed ─► the loop above, with gains of its own
//                              └──────────── counted place ◄───────────┘
//
// Each trial begins at rest, and the same setup gives the same numbers.
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
  Seconds smoothing{0.0005};  // of the counted speed
  Controlled controlled = Controlled::speed;
  PidGains gains = {};            // N·m for each rad/s; of a position loop: rad/s for each radian
  PidGains speed_gains = {};      // of the inner loop of a position loop
  double to = 0;                  // rad/s or radians
  RadiansPerSecond fastest{200};  // the most that a position loop asks of the inner one
  NewtonMetres load = {};         // against the motion, from `load_at` on
  Seconds load_at{0};
};

struct LoopMoment {
  Seconds time{0};
  double wanted = 0;
  double counted = 0;  // as the controller sees it
  double is = 0;       // true
  RadiansPerSecond speed = {};
  NewtonMetres asked = {};  // of the motor
  NewtonMetres torque = {};
};

// One moment for each period.
std::vector<LoopMoment> step_response(const LoopSetup& setup, Seconds whole);

struct LoopFigures {
  std::optional<Seconds> rise = {};     // from a tenth to nine tenths
  double overshoot = 0;                 // share of the jump
  std::optional<Seconds> settled = {};  // from then on within 5 % of the jump
  double error = 0;                     // at the end: the mean of the last tenth of the time
  double swing = 0;                     // at the end: between the highest and the lowest value there
};

// Before the load comes, if it does.
LoopFigures figures_of(const std::vector<LoopMoment>& moments, const LoopSetup& setup);

// The gain at which the loop with P alone just swings for ever, found by trials. Empty: it does not swing at any gain
// that the motor's torque can show.
std::optional<UltimateCycle> ultimate_cycle(const LoopSetup& setup);

}  // namespace passo
