// Trace: a file with every step of a machine. TraceVcd and TraceCsv are its two formats.
//
// A trace observes a virtual machine and passes on its text in large pieces, to an OutputFile or another sink. Its
// memory does not depend on the length of the job.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/motor/excitation.hpp"
#include "passo/units/units.hpp"

namespace passo {

// A motor of the machine, and the axis that it drives.
struct TraceMotor {
  Axis axis = Axis::x;
  bool inverted = false;  // the axis moves up when the motor counts down
};

struct TraceOptions {
  std::vector<TraceMotor> motors;  // in the order of the board's motors, at most max_motors
  Hertz clock{16e6};               // the board's timer: a whole number of hertz below 2^32
  Seconds step_pulse{2.5e-6};
  std::optional<Excitation> windings = {};  // not for microsteps; empty: the board does not switch windings itself
};

// The windings of a board's motors, starting as after a reset: no current before a motor's first step.
class TraceWindings {
 public:
  static constexpr unsigned outputs = 4;  // F1 to F4 of each motor

  explicit TraceWindings(const std::optional<Excitation>& excitation) : excitation_(excitation) {}
  bool exist() const { return excitation_.has_value(); }
  // Applies a step. Returns the outputs that change.
  unsigned step(unsigned motor, bool down) {
    places_[motor] += down ? -1 : 1;
    const std::uint8_t before = patterns_[motor];
    patterns_[motor] = excitation_->at(places_[motor]).pattern;
    return before ^ patterns_[motor];
  }
  bool is_on(unsigned motor, unsigned output) const { return (patterns_[motor] >> output & 1U) != 0; }

 private:
  std::optional<Excitation> excitation_;
  std::array<std::int64_t, max_motors> places_{};
  std::array<std::uint8_t, max_motors> patterns_{};
};

using TraceSink = std::function<void(std::string_view)>;

class Trace : public MachineObserver {
 public:
  // Writes the remaining output. The machine has stopped at `end`. Must be called once, after everything else.
  virtual void finish(Ticks end) = 0;
};

}  // namespace passo
