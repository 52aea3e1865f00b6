// ToleranceTrial: plays the motion of one axis with the physics of several motors at once, from the weakest to the
// strongest of its tolerance, and tells which of them lose steps.
//
// The motion comes piece by piece, and becomes the steps of the axis's driver. A board makes steps at the events of the
// fastest motor, so the steps of the others are late by up to one event: a jitter that makes rotors ring. The steps
// here have the same jitter. Only the last moments of the motion are kept:
//
//   pieces ──▶ steps ──▶ six BoundedMotors, from the weakest to the strongest ──▶ who lost steps, and how far they
//   swung
//
// The weakest motor lacks its tolerance and a reserve. Other motors may lose steps where both ends keep theirs, because
// the rates that make a rotor swing depend on its strength. Four of the six are weaker than usual, because weak motors
// are the ones that lose steps. A motor that has lost steps is left out until the axis rests.
//
// Cost. A second of motion takes 10 to 15 ms, so a long program is not played whole:
//
//   - a run at an even speed is played for its first second; whole periods of the motor's teeth after it are left out
//   - after the first minute of an axis only pieces of a kind that was played for less than half a second are played,
//   and
//     what follows in the next 50 ms. The kind is what a piece needs of the torque, what was needed before, and the
//     speed
//   - after two minutes nothing is played
//
// In mid-motion the motors are carried to the speed, the lag and the currents of the motion first, and follow its last
// 0.2 s. Memory does not depend on the program. The same pieces give the same findings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "passo/motor/bounded_motor.hpp"

namespace passo {

// A piece of an axis's motion: a cubic in time between two places with their speeds.
struct AxisPiece {
  Seconds duration{0};
  double from = 0;  // mm or degrees
  double to = 0;
  double speed_from = 0;  // per second, with its sign
  double speed_to = 0;
  double load = 0;               // the share of the torque that the piece needs
  NewtonMetres resistance = {};  // a torque of the work against the motion, whichever way it goes
  // The motor whose grid of places makes the board's events, in lines of that grid. The same at both ends: this axis's
  // own motor.
  double grid_from = 0;
  double grid_to = 0;

  // The mean.
  double acceleration() const { return (speed_to - speed_from) / duration.value(); }
};

struct TrialFinding {
  // Whether the piece was played, or is of a kind that was played often. If not, nothing is known of it.
  bool judged = false;
  int lost = 0;           // motors that lost steps in this piece
  double most_swing = 0;  // the largest lag of a motor in this piece, in full steps
  // The usual motor and a weaker one have lost steps since the axis began to move.
  bool usual_out = false;
};

class ToleranceTrial {
 public:
  static constexpr std::size_t motor_count = 6;
  // The share of its torque by which the weakest motor is weaker still than the tolerance says. The machine is never
  // quite as its file describes it.
  static constexpr double reserve = 0.05;

  // `tolerance`: 0 to 0.5. `radians_per_unit`: of the shaft, for a mm or a degree of the axis. `fastest`: of the shaft.
  ToleranceTrial(const MotorSetup& setup, double tolerance, double radians_per_unit, RadiansPerSecond fastest);

  TrialFinding play(const AxisPiece& piece);
  // The axis rests.
  TrialFinding stand(Seconds time);

  // The usual motor, which is as the machine file says, has lost steps somewhere, and so has one that is weaker by half
  // of the tolerance.
  bool usual_lost() const { return (ever_lost_ & usual) == usual; }
  // Motion that was played, for each motor.
  Seconds played() const { return Seconds(played_); }

 private:
  static constexpr unsigned usual = 0b011000;  // bits of `out_`
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
  std::vector<BoundedMotor> motors_;  // empty: nothing is played at present
  unsigned out_ = 0;                  // a bit for each motor that has lost steps since the axis began to move
  unsigned ever_lost_ = 0;
  std::int64_t commanded_ = 0;
  double origin_ = 0;      // the place of the axis where `commanded_` is 0, in steps
  double resistance_ = 0;  // N·m, that the motors feel now
  double pending_ = 0;     // s that the motors have yet to live through; negative after a step that was late
  double stood_ = 0;       // s
  double played_ = 0;      // s
  double to_play_ = 0;     // s after a piece of a new kind
  double load_before_ = 0;
  std::deque<AxisPiece> skipped_;  // the last of the pieces that were not played
  double time_skipped_ = 0;        // s
  double most_swing_ = 0;
  std::array<float, loads * loads * speeds> kinds_{};  // s that each kind was played
};

}  // namespace passo
