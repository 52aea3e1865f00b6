// Trace: a file with every step of a machine. TraceVcd and TraceCsv are its two forms.
//
// A trace watches a virtual machine and hands on its text in large pieces, to an OutputFile or another sink. A trace
// needs the same memory for a job of any length.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/units/units.hpp"

namespace passo {

// A motor of the machine, and the axis that the motor turns.
struct TraceMotor {
  Axis axis = Axis::x;
  bool inverted = false;  // true: the axis goes up when the motor counts down
};

struct TraceOptions {
  std::vector<TraceMotor> motors;  // in the order of the board's motors, at most max_motors
  Hertz clock{16e6};               // the board's timer: a whole number of hertz below 2^32
  Seconds step_pulse{2.5e-6};
};

using TraceSink = std::function<void(std::string_view)>;

class Trace : public MachineObserver {
 public:
  // Writes what is left. The machine has come to rest at `end`. Call it once, after everything else.
  virtual void finish(Ticks end) = 0;
};

}  // namespace passo
