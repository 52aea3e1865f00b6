// ToleranceTrial: simulates the motion of one axis with several motors at once, from the weakest to the strongest of
// its tolerance, and reports which of them lose steps.
//
// The motion arrives piece by piece, and is converted to the steps of the axis's driver. A board generates steps at the
// events of the fastest motor, so the steps of the other motors are late by up to one event; this jitter excites
// ringing of the rotors. The simulated steps have the same jitter. Only the most recent motion is kept:
//
//   pieces ──▶ steps ──▶ six BoundedMotors, from the weakest to the strongest ──▶ lost steps, and the maximum lag
//
// The weakest motor is weaker than nominal by its tolerance and a reserve. Motors in between may lose steps even if
// both extremes keep theirs, because the rates that excite a rotor depend on its torque. Four of the six are weaker
// than nominal, because weak motors are the ones that lose steps. A motor that has lost steps is ignored until the axis
// stops.
//
// Cost. A second of motion takes 10 to 15 ms, so a long program is not simulated completely:
//
// - motion at constant speed is simulated for its first second; after that, whole periods of the motor's teeth are
//   skipped
// - after the first minute of an axis, only pieces of a kind that has been simulated for less than half a second are
//   simulated, and the following 50 ms. A kind is defined by the torque utilisation of the piece, the previous
//   utilisation, and the speed
// - after two minutes nothing is simulated
//
// If a simulation begins during motion, the motors are first initialised with the speed, the lag and the currents of
// the motion, and follow its last 0.2 s. Memory does not depend on the program. The same pieces give the same findings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "passo/motor/bounded_motor.hpp"

namespace passo {

// A piece of an axis's motion: a cubic in time between two positions with their speeds.
struct AxisPiece {
  Seconds duration{0};
  double from = 0;  // mm or degrees
  double to = 0;
  double speed_from = 0;  // speed per second, signed
  double speed_to = 0;
  double load = 0;               // torque utilisation of the piece
  NewtonMetres resistance = {};  // torque of the cutting force, against the motion in either direction
  // The position, in lines of the grid, of the motor whose steps define the board's events. Equal at both ends: this
  // axis's own motor defines them.
  double grid_from = 0;
  double grid_to = 0;

  // Returns the mean acceleration.
  double acceleration() const { return (speed_to - speed_from) / duration.value(); }
};

struct TrialFinding {
  // Whether the piece was simulated, or is of a kind that was simulated often. If not, nothing is known about it.
  bool judged = false;
  int lost = 0;           // number of motors that lost steps in this piece
  double most_swing = 0;  // maximum lag of a motor in this piece, in full steps
  // The nominal motor and a weaker one have lost steps since the axis began to move.
  bool usual_out = false;
};

class ToleranceTrial {
 public:
  static constexpr std::size_t motor_count = 6;
  // The fraction of its torque by which the weakest motor is weaker than the tolerance allows, because a machine never
  // matches its file exactly.
  static constexpr double reserve = 0.05;

  // `tolerance`: 0 to 0.5. `radians_per_unit`: shaft angle per mm or degree of the axis. `fastest`: of the shaft.
  ToleranceTrial(const MotorSetup& setup, double tolerance, double radians_per_unit, RadiansPerSecond fastest);

  TrialFinding play(const AxisPiece& piece);
  // Adds a standstill of the axis.
  TrialFinding stand(Seconds time);

  // Returns whether the nominal motor, as described in the machine file, has ever lost steps, and so has one that is
  // weaker by half of the tolerance.
  bool usual_lost() const { return (ever_lost_ & usual) == usual; }
  // Returns the duration of the simulated motion, for each motor.
  Seconds played() const { return Seconds(played_); }

 private:
  static constexpr unsigned usual = 0b011000;  // the motors in `out_` that count as nominal
  static constexpr std::size_t loads = 12;
  static constexpr std::size_t speeds = 32;
  struct Path;

  TrialFinding finding_since(unsigned out_before) const;
  float& played_of_kind(const AxisPiece& piece);
  void skip(const AxisPiece& piece);
  void forget_skipped();
  void begin(const AxisPiece& piece);
  void carry_to(const AxisPiece& piece);
  double follow(const AxisPiece& piece);
  void follow(const Path& path, const Path& grid, double duration, bool carried);
  void resist(NewtonMetres torque);
  void step(int way);
  void pass(double time);
  void stop();

  std::vector<MotorSetup> setups_;  // the weakest first
  double steps_per_unit_;
  double radians_per_unit_;
  double fastest_;
  std::vector<BoundedMotor> motors_;  // empty: nothing is being simulated
  unsigned out_ = 0;                  // one bit for each motor that has lost steps since the axis began to move
  unsigned ever_lost_ = 0;
  std::int64_t commanded_ = 0;
  double origin_ = 0;      // position of the axis where `commanded_` is 0, in steps
  double resistance_ = 0;  // N·m, currently acting on the motors
  double pending_ = 0;     // s that still have to be simulated; negative after a late step
  double stood_ = 0;       // duration of the standstill, s
  double played_ = 0;      // simulated time, s
  double to_play_ = 0;     // s to simulate after a piece of a new kind
  double load_before_ = 0;
  std::deque<AxisPiece> skipped_;  // the last pieces that were not simulated
  double time_skipped_ = 0;        // skipped time, s
  double most_swing_ = 0;
  std::array<float, loads * loads * speeds> kinds_{};  // simulated time of each kind, s
};

}  // namespace passo
