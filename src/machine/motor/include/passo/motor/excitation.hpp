// Excitation: the effect of a driver's step on the windings: the active outputs, the current of both phases, and the
// angle at which an unloaded rotor stops.
//
//   two on       1100 0110 0011 1001   both phases at full current: 1.4 times the torque, for twice the power
//   wave         1000 0100 0010 0001   one phase at a time
//   half step    alternates the two, eight patterns
//   microsteps   N per full step: the currents are sine and cosine, and the field turns by 90°/N
//
// The patterns are those of the firmware (firmware/winding_table.hpp): outputs F1 to F4 in their order of rotation, F1
// and F3 the two halves of phase A, F2 and F4 those of phase B. So the current of A is that of F1 minus that of F3. The
// field has the direction of the sum of the two current vectors; a full step turns it by a quarter turn, and the rotor
// by a full step.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

struct WindingState {
  std::uint8_t pattern = 0;  // bit 0: F1 carries current
  double phase_a = 0;        // fraction of the rated current, −1 … 1
  double phase_b = 0;

  bool on(unsigned output) const { return (pattern >> output & 1) != 0; }  // 0: F1
};

class Excitation {
 public:
  // Accepts "two-on", "wave", "half-step" or "microsteps:N" with N from 2 to 256. The error text fits after "--drive:
  // ".
  static Result<Excitation, std::string> named(std::string_view name);

  WindingState at(std::int64_t place) const;
  int steps_per_full_step() const { return steps_; }
  // True for microsteps: the currents are sines.
  bool is_sine() const { return kind_ == Kind::microsteps; }
  // The angle of an unloaded rotor at `place`, relative to place 0, in degrees.
  double rotor_degrees(std::int64_t place, std::int32_t full_steps_per_turn) const;
  const std::string& name() const { return name_; }

 private:
  enum class Kind : std::uint8_t { two_on, wave, half_step, microsteps };

  Excitation(Kind kind, int steps, std::string_view name) : kind_(kind), steps_(steps), name_(name) {}

  Kind kind_;
  int steps_;
  std::string name_;
};

}  // namespace passo
