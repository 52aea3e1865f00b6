// TraceVcd: the board's lines over time as a value change dump (IEEE 1364-2005, 18), for GTKWave and similar viewers.
//
// Each axis of the machine has lines like X_step and X_dir. X_dir is the level of the line (1: the motor counts down).
// So for an inverted motor, X_dir is opposite to the axis's direction. After the axes come spindle, spindle_reverse,
// mist, flood and spindle_rpm. Where the board switches windings by itself, X_F1 to X_F4 and so on come last.
//
//   X_dir  ____/‾‾‾‾‾‾‾‾‾‾‾‾     changes together with the first step in that direction
//   X_step ____/‾\______/‾\_     high for the step pulse, but at most half the time to the next steps or outputs
//
// Time is exact. The unit of time is the largest power of ten seconds of which a tick is a multiple. But the unit is
// always less than a tick, because half a tick needs a place too. If a tick is no whole number of picoseconds, the unit
// is a picosecond and times are rounded. The file has no date, so that the same job gives the same bytes. An event
// takes about 30 ns.
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
  // The unit of the file's time.
  struct Scale {
    explicit Scale(Hertz clock);
    std::uint64_t units(std::uint64_t ticks) const;
    std::uint64_t ticks_a_second;
    std::uint64_t units_a_tick = 0;  // 0: a tick is no whole number of picoseconds
    std::uint64_t picoseconds = 1;   // in one unit
  };

  void put_header(const TraceOptions& options);
  void put_variable(unsigned bits, unsigned wire, std::string_view name);
  void put_bit(unsigned wire, bool value);
  void put_rpm(unsigned value);
  void put_time(std::uint64_t time);
  void close_pulse(std::uint64_t longest);

  // The wires in the order of their codes: step and direction of each motor, then the outputs.
  static unsigned step_wire(unsigned motor) { return 2 * motor; }
  static unsigned direction_wire(unsigned motor) { return 2 * motor + 1; }
  unsigned output_wire(unsigned output) const { return 2 * motors_ + output; }
  unsigned winding_wire(unsigned motor, unsigned output) const;

  TraceBuffer buffer_;
  Scale scale_;
  unsigned motors_;
  std::uint64_t step_pulse_;  // from here on all times are in units
  std::uint64_t now_ = 0;
  std::uint64_t rose_at_ = 0;
  unsigned high_ = 0;  // the step lines that are high
  unsigned directions_ = 0;
  BoardOutputs outputs_;
  TraceWindings windings_;
};

}  // namespace passo
