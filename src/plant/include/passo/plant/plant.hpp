// Plant: the world behind a board. Motors and what they move, switches, the probe and what it touches, the spindle.
//
// Place on the street: behind its end. A board drives the plant: step pulses and the spindle's command go in, the
// states of the board's input pins come out. A board knows what it commanded; only the plant knows what is true. The
// virtual machine and the emulated boards drive the same plant; behind a real board is the real world.
//
// Invariant: `time` is the board's own, from any start, and never goes back. Positions are counted from machine zero
// of the true machine, not from where somebody began to count.
#pragma once

#include <cstdint>
#include <limits>

#include "passo/plant/motor_steps.hpp"
#include "passo/plant/virtual_spindle.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Truth {
  MotorPositions positions{};  // from machine zero
  double spindle_turns = 0;    // since the start
  std::uint16_t inputs = 0;    // bits of BoardInput: what is closed
};

class Plant {
 public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  virtual ~Plant() = default;

  // The pulses that each motor has got since the last call. `time`: of the last of them.
  virtual void pulse(Seconds time, const MotorSteps& steps) = 0;
  // How many events may pass, with one pulse a motor at most in each, until an input may change: 1 or more, or never.
  // A board may give the pulses of so many events as one sum; then it asks for the inputs. A plant that must see each
  // pulse says 1.
  virtual std::int64_t events_to_next_change() const = 0;
  // Revolutions a minute from that time on, below 0 the other way.
  virtual void command_spindle(Seconds time, double revolutions_per_minute) = 0;
  // Somebody closes switches, or opens them: bits of BoardInput.
  virtual void set_switch(std::uint16_t which, bool closed) = 0;

  // Bits of BoardInput: what is closed.
  virtual std::uint16_t inputs_at(Seconds time) = 0;
  // The spindle as it turns, with its encoder, if it has one.
  virtual const VirtualSpindle& spindle() const = 0;
  // A board that keeps sums back gives them at the end of each run(); in between the motors are further.
  virtual Truth truth_at(Seconds time) = 0;
};

}  // namespace passo
