// TraceVcd: the board's lines over time as a value change dump (IEEE 1364-2005, 18), for GTKWave and its like.
//
// A machine has for each axis X_step and X_dir (1: the motor counts down; the level of the line, so an inverted motor
// shows the other way round than its axis), then spindle, spindle_reverse, mist, flood and spindle_rpm.
//
//   X_dir  ____/‾‾‾‾‾‾‾‾‾‾‾‾     set together with the first step that way
//   X_step ____/‾\______/‾\_     high for the step pulse, but at most half the time to the next event with steps
//
// Time is exact: the unit is the largest power of ten that a tick is a multiple of (a true one: half a tick needs a
// place too). Where a tick is no whole number of picoseconds, the unit is that and times are rounded.
// No date: the same job gives the same bytes. Cost: about 30 ns an event.
#pragma once

#include <cstdint>

#include "passo/report/trace.hpp"
#include "passo/report/trace_buffer.hpp"

namespace passo {

class TraceVcd final : public Trace {
 public:
  // Hands on the header with the first piece of text.
  TraceVcd(const TraceOptions& options, TraceSink sink);

  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override;
  void on_outputs(Ticks time, const BoardOutputs& outputs) override;
  void finish(Ticks end) override;

 private:
  // What one unit of the file's time is.
  struct Scale {
    explicit Scale(Hertz clock);
    std::uint64_t units(std::uint64_t ticks) const;
    std::uint64_t ticks_a_second;
    std::uint64_t units_a_tick = 0;  // 0: no whole number
    std::uint64_t picoseconds = 1;   // a unit
  };

  void put_header(const TraceOptions& options);
  void put_variable(unsigned bits, unsigned wire, std::string_view name);
  void put_bit(unsigned wire, bool value);
  void put_rpm(unsigned value);
  void put_time(std::uint64_t time);
  void close_pulse(std::uint64_t longest);

  // Wires in the order of their codes: of each motor step and direction, then the outputs.
  static unsigned step_wire(unsigned motor) { return 2 * motor; }
  static unsigned direction_wire(unsigned motor) { return 2 * motor + 1; }
  unsigned output_wire(unsigned output) const { return 2 * motors_ + output; }

  TraceBuffer buffer_;
  Scale scale_;
  unsigned motors_;
  std::uint64_t step_pulse_;  // from here on all times are in units
  std::uint64_t now_ = 0;
  std::uint64_t rose_at_ = 0;
  unsigned high_ = 0;  // the step lines that are
  unsigned directions_ = 0;
  BoardOutputs outputs_;
};

}  // namespace passo
