// AxisTuner: proposes velocity, acceleration and jerk for an axis whose motor is known, so that a margin of the weakest
// motor's torque is never used.
//
//   usable(v) = (1 - margin) · pull-out of the weakest motor at v          TorqueBand, its low end
//   a(v)      = (usable(v) - friction(v) - weight) / inertia               the most that may be asked for up to v
//   j(v)      = a(v) / T(v)          T = 2π·√(J / (N·pull-out·cos δ)), sin δ = 1 - margin: the ringing's period
//
// Torque falls with the speed, so a higher velocity costs acceleration. The criterion: the slowest velocity with which
// a reference move (half of the travel, from rest to rest) takes at most 1 % longer than with any other one. At that
// velocity and at all below, the weakest, the usual and the strongest motor do not swing by themselves: a slow sweep
// through all rates tries them.
//
// The jerk: an acceleration that rises within one period of the rotor's ringing leaves no ringing behind (the response
// to a ramp of one period is at rest where the ramp ends). The weakest motor has the longest period.
//
// Cutting forces are not known. The margin is for them, and for what the motor's data leave out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/motor/torque_band.hpp"

namespace passo {

struct TuningWish {
  double margin = 0;       // of the weakest motor's torque; the caller's default stands in TuneArguments
  double way = 0;          // of the reference move, mm or degrees; 0: half of the travel
  MmPerSecond fastest{0};  // a velocity that must not be exceeded; 0: none but the board's
};

// What kept the velocity from being higher.
enum class TuningBound : std::uint8_t {
  time,    // a higher one takes acceleration, and saves no time
  torque,  // above, none is left
  board,   // its steps a second
  wish,    // TuningWish::fastest
  swing,   // the motor may lose steps through resonance above
};

// Torques at one speed of the axis, at the motor's shaft.
struct TuningPoint {
  MmPerSecond speed{0};
  NewtonMetres pull_out = {};  // of the weakest motor
  NewtonMetres steady = {};    // the same where the motor has the time to swing
  NewtonMetres usable = {};
  NewtonMetres needed = {};  // to accelerate as proposed; at speeds above the proposed one, to go on
};

struct AxisTuning {
  Axis axis = Axis::x;
  double margin = 0;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  MmPerSecond3 jerk{0};
  TuningBound bound = TuningBound::time;
  Seconds period{0};  // of the weakest motor's ringing
  double way = 0;     // of the reference move
  Seconds time{0};    // that it takes
  std::vector<TuningPoint> curve = {};
};

struct TuningRefusal {
  std::string message;  // why no velocity is possible
};

class AxisTuner {
 public:
  // Empty: the machine file does not describe the axis's motor, or its driver does not divide a full step evenly.
  static std::optional<AxisTuner> of(const AxisDescription& axis, const BoardDescription& board);

  // Takes some tenths of a second for the trials of the motor. Values are rounded down to three digits.
  Result<AxisTuning, TuningRefusal> propose(const TuningWish& wish) const;

 private:
  AxisTuner(const AxisDescription& axis, const BoardDescription& board, MotorSetup setup);

  struct Choice;
  double friction_at(double speed) const;
  double acceleration_at(const TorqueBand& band, double share, double speed) const;
  double period_at(const TorqueBand& band, double share, double speed) const;
  double usable_at(const TorqueBand& band, double share, double speed) const;
  double torque_ends_at(const TorqueBand& band, double share, double top) const;
  double calm_to(double top) const;
  double steady_up_to(const TorqueBand& band, double share, double top) const;
  Choice choose(const TorqueBand& band, double share, double way, double top) const;
  TorqueBand band_to(double speed) const;
  AxisTuning result_of(const TorqueBand& band, const TuningWish& wish, double way, double velocity,
                       double picture_end) const;

  AxisDescription axis_;
  Hertz most_steps_;
  MotorSetup setup_;
  double inertia_ = 0;  // kg·m²
  double weight_ = 0;   // N·m
  double radians_per_unit_ = 0;
  bool coarse_steps_ = false;  // full or half steps: each step makes the rotor ring
};

// The time of a move from standstill to standstill with constant limits. All above 0.
Seconds time_of_move(double way, MmPerSecond velocity, MmPerSecond2 acceleration, MmPerSecond3 jerk);

}  // namespace passo
