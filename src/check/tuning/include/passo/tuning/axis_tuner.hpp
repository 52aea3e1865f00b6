// AxisTuner: proposes velocity, acceleration and jerk limits for an axis with a known motor, so that a margin of the
// weakest motor's torque always remains unused.
//
//   usable(v) = (1 - margin) · pull-out of the weakest motor at v          TorqueBand, its low end
//   a(v)      = (usable(v) - friction(v) - weight) / inertia               the acceleration limit up to v
//   j(v)      = a(v) / T(v)          T = 2π·√(J / (N·pull-out·cos δ)), sin δ = 1 - margin: the ringing's period
//
// Torque falls with speed, so a higher velocity costs acceleration. The criterion: the lowest velocity with which a
// reference move (half of the travel, from stop to stop) takes at most 1 % longer than with any other velocity. At and
// below that velocity, the weakest, the nominal and the strongest motor must not oscillate by themselves: this is
// tested in a slow sweep through all rates.
//
// The jerk: an acceleration that rises over one period of the rotor's ringing causes no residual ringing (the response
// to a ramp of one period is at rest when the ramp ends). The weakest motor has the longest period.
//
// Cutting forces are unknown. The margin is for them, and for effects that the motor's data does not include.
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
  double margin = 0;       // fraction of the weakest motor's torque; TuneArguments has the default of the callers
  double way = 0;          // length of the reference move, mm or degrees; 0: half of the travel
  MmPerSecond fastest{0};  // an upper limit of the velocity; 0: only the board's limit
};

// The limit that determined the velocity.
enum class TuningBound : std::uint8_t {
  time,    // a higher velocity reduces the acceleration and saves no time
  torque,  // above it no torque is left
  board,   // the board's step rate
  wish,    // the upper limit TuningWish::fastest
  swing,   // the motor may lose steps through resonance above
};

// Torques at one speed of the axis, at the motor's shaft.
struct TuningPoint {
  MmPerSecond speed{0};
  NewtonMetres pull_out = {};  // pull-out torque of the weakest motor
  NewtonMetres steady = {};    // the same, if the motor has time to oscillate
  NewtonMetres usable = {};
  NewtonMetres needed = {};  // to accelerate as proposed; above the proposed velocity, to keep the speed
};

struct AxisTuning {
  Axis axis = Axis::x;
  double margin = 0;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  MmPerSecond3 jerk{0};
  TuningBound bound = TuningBound::time;
  Seconds period{0};  // ringing period of the weakest motor
  double way = 0;     // length of the reference move
  Seconds time{0};    // duration of the reference move
  std::vector<TuningPoint> curve = {};
};

struct TuningRefusal {
  std::string message;  // why no velocity is possible
};

class AxisTuner {
 public:
  // Returns nothing if the machine file does not describe the axis's motor, or if its driver does not divide a full
  // step evenly.
  static std::optional<AxisTuner> of(const AxisDescription& axis, const BoardDescription& board);

  // Takes some tenths of a second for the simulated sweeps. Values are rounded down to three digits.
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
  bool coarse_steps_ = false;  // full or half steps: each step excites ringing of the rotor
};

// Returns the duration of a move from stop to stop with constant limits. All arguments must be above 0.
Seconds time_of_move(double way, MmPerSecond velocity, MmPerSecond2 acceleration, MmPerSecond3 jerk);

}  // namespace passo
