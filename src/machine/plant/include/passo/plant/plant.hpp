// Plant: the world behind a board: the motors and what they move, the switches, the probe and what it touches, and the
// spindle.
//
// Position in the pipeline: after the board, which is its end. A board drives the plant: step pulses and the spindle's
// command go in, and the states of the board's input pins come out. A board knows the commanded positions; only the
// plant knows the true ones. The virtual machine and the emulated boards drive the same kind of plant. Behind a real
// board is the real world.
//
// Invariants: `time` is the board's own time, from any start, and never goes back. Positions are counted from the true
// machine's zero, not from where somebody began to count.
#pragma once

#include <cstdint>
#include <limits>

#include "passo/plant/motor_steps.hpp"
#include "passo/plant/virtual_spindle.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Truth {
  MotorPositions positions{};  // of the slides, in steps of their motors from machine zero
  double spindle_turns = 0;    // since the start
  std::uint16_t inputs = 0;    // bits of BoardInput: the closed inputs
};

class Plant {
 public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  virtual ~Plant() = default;

  // Gives the pulses that each motor has got since the last call. `time`: the time of the last pulse.
  virtual void pulse(Seconds time, const MotorSteps& steps) = 0;
  // How many events may pass until an input may change: 1 or more, or `never`. An event has at most one pulse for each
  // motor. A board may give the pulses of that many events as one sum, and then asks for the inputs. A plant that must
  // see each pulse returns 1.
  virtual std::int64_t events_to_next_change() const = 0;
  // Sets the spindle's speed from `time` on. Negative: the other way round.
  virtual void command_spindle(Seconds time, double revolutions_per_minute) = 0;
  // Closes or opens switches by hand. `which`: bits of BoardInput.
  virtual void set_switch(std::uint16_t which, bool closed) = 0;

  // The closed inputs, as bits of BoardInput.
  virtual std::uint16_t inputs_at(Seconds time) = 0;
  // The spindle as it turns, with its encoder if there is one.
  virtual const VirtualSpindle& spindle() const = 0;
  // What is true at `time`. A board that keeps sums back gives them at the end of each run(). During a run() the motors
  // may be further than the plant tells.
  virtual Truth truth_at(Seconds time) = 0;
};

}  // namespace passo
