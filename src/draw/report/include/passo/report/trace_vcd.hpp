// TraceVcd: the board's signals over time as a value change dump (IEEE 1364-2005, 18), for GTKWave and similar viewers.
//
// Each axis of the machine has signals such as X_step and X_dir. X_dir is the level of the signal (1: the motor counts
// down), so for an inverted motor it is opposite to the direction of the axis. After the axes come spindle,
// spindle_reverse, mist, flood and spindle_rpm. If the board switches windings itself, X_F1 to X_F4 and so on come
// last.
//
//   X_dir  ____/‾‾‾‾‾‾‾‾‾‾‾‾     changes together with the first step in that direction
//   X_step ____/‾\______/‾\_     high for the step pulse, but at most half the time to the next steps or outputs
//
// Time is exact. The time unit is the largest power of ten seconds that divides a tick and is shorter than the tick, so
// that half a tick can be represented. If a tick is not a whole number of picoseconds, the unit is a picosecond and
// times are rounded. The file contains no date, so the same job gives the same bytes. An event takes about 30 ns.
#pragma once

#include <cstdint>

#include "passo/report/trace.hpp"
#include "passo/report/trace_buffer.hpp"

namespace passo {

class TraceVcd final : public Trace {
 public:
  // The first piece of text begins with the header.
  TraceVcd(const TraceOptions& options, TraceSink sink);

  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override;
  void on_outputs(Ticks time, const BoardOutputs& outputs) override;
  void finish(Ticks end) override;

 private:
  // The time unit of the file.
  struct Scale {
    explicit Scale(Hertz clock);
    std::uint64_t units(std::uint64_t ticks) const;
    std::uint64_t ticks_a_second;
    std::uint64_t units_a_tick = 0;  // units per tick; 0: a tick is not a whole number of picoseconds
    std::uint64_t picoseconds = 1;   // picoseconds per unit
  };

  void put_header(const TraceOptions& options);
  void put_variable(unsigned bits, unsigned wire, std::string_view name);
  void put_bit(unsigned wire, bool value);
  void put_rpm(unsigned value);
  void put_time(std::uint64_t time);
  void close_pulse(std::uint64_t longest);

  // The signals in the order of their codes: step and direction of each motor, then the outputs.
  static unsigned step_wire(unsigned motor) { return 2 * motor; }
  static unsigned direction_wire(unsigned motor) { return 2 * motor + 1; }
  unsigned output_wire(unsigned output) const { return 2 * motors_ + output; }
  unsigned winding_wire(unsigned motor, unsigned output) const;

  TraceBuffer buffer_;
  Scale scale_;
  unsigned motors_;
  std::uint64_t step_pulse_;  // from here on, all times are in units
  std::uint64_t now_ = 0;
  std::uint64_t rose_at_ = 0;
  unsigned high_ = 0;  // the step signals that are high
  unsigned directions_ = 0;
  BoardOutputs outputs_;
  TraceWindings windings_;
};

}  // namespace passo
