// Plant: the simulated hardware behind a board: the motors and the axes that they move, the switches, the probe and the
// objects that it touches, and the spindle.
//
// Position in the pipeline: after the board, at the end. A board drives the plant: its inputs are step pulses and the
// spindle's command, its outputs the states of the board's input pins. A board knows the commanded positions; only the
// plant knows the true ones. The virtual machine and the emulated boards drive the same kind of plant. A real board
// drives the real machine instead.
//
// Invariants: `time` is the board's own time, from an arbitrary zero, and never decreases. Positions are counted from
// the true machine zero.
#pragma once

#include <cstdint>
#include <limits>

#include "passo/plant/motor_steps.hpp"
#include "passo/plant/virtual_spindle.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Truth {
  MotorPositions positions{};  // of the slides, in steps of their motors from machine zero
  double spindle_turns = 0;    // revolutions since the start
  std::uint16_t inputs = 0;    // bits of BoardInput: the closed inputs
};

class Plant {
 public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  virtual ~Plant() = default;

  // Passes the pulses of each motor since the last call. `time`: the time of the last pulse.
  virtual void pulse(Seconds time, const MotorSteps& steps) = 0;
  // The number of events until an input may change: 1 or more, or `never`. An event has at most one pulse for each
  // motor. A board may pass the pulses of that many events as one sum, and then reads the inputs. A plant that must
  // process each pulse returns 1.
  virtual std::int64_t events_to_next_change() const = 0;
  // Sets the spindle's speed from `time` on. Negative: reverse.
  virtual void command_spindle(Seconds time, double revolutions_per_minute) = 0;
  // Closes or opens switches by hand. `which`: bits of BoardInput.
  virtual void set_switch(std::uint16_t which, bool closed) = 0;

  // The closed inputs, as bits of BoardInput.
  virtual std::uint16_t inputs_at(Seconds time) = 0;
  // The spindle's actual motion, with its encoder if there is one.
  virtual const VirtualSpindle& spindle() const = 0;
  // The true state at `time`. A board that accumulates sums passes them at the end of each run(). During a run() the
  // motors may be ahead of the returned state.
  virtual Truth truth_at(Seconds time) = 0;
};

}  // namespace passo
