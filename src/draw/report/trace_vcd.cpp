#include "passo/report/trace_vcd.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

namespace passo {
namespace {

constexpr std::uint64_t million = 1'000'000;
constexpr std::array<std::string_view, 4> switch_names = {"spindle", "spindle_reverse", "mist", "flood"};
constexpr unsigned rpm_output = switch_names.size();
constexpr unsigned rpm_bits = 16;

// A power of ten of picoseconds in the format's form: 1, 10 or 100 of a unit.
std::string timescale(std::uint64_t picoseconds) {
  constexpr std::array<const char*, 5> units = {" ps", " ns", " us", " ms", " s"};
  std::size_t unit = 0;
  for (; picoseconds >= 1000; picoseconds /= 1000) ++unit;
  return std::to_string(picoseconds) + units[unit];
}

}  // namespace

TraceVcd::Scale::Scale(Hertz clock) : ticks_a_second(static_cast<std::uint64_t>(std::llround(clock.value()))) {
  constexpr std::uint64_t second = million * million;
  if (second % ticks_a_second != 0) return;
  units_a_tick = second / ticks_a_second;
  while (units_a_tick % 10 == 0 && units_a_tick > 10) {
    units_a_tick /= 10;
    picoseconds *= 10;
  }
}

std::uint64_t TraceVcd::Scale::units(std::uint64_t ticks) const {
  if (units_a_tick != 0) return ticks * units_a_tick;
  // Long division with two digits of base 10^6, the last one rounded. No intermediate result exceeds 64 bits.
  const std::uint64_t seconds = ticks / ticks_a_second;
  const std::uint64_t micro = ticks % ticks_a_second * million;
  const std::uint64_t pico = (2 * million * (micro % ticks_a_second) + ticks_a_second) / (2 * ticks_a_second);
  return (seconds * million + micro / ticks_a_second) * million + pico;
}

TraceVcd::TraceVcd(const TraceOptions& options, TraceSink sink)
    : buffer_(std::move(sink)),
      scale_(options.clock),
      motors_(static_cast<unsigned>(options.motors.size())),
      windings_(options.windings) {
  assert(motors_ <= max_motors);
  const double pulse = options.step_pulse.value() * 1e12 / static_cast<double>(scale_.picoseconds);
  step_pulse_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(pulse)));
  put_header(options);
}

void TraceVcd::put_header(const TraceOptions& options) {
  buffer_.put("$version Passo $end\n$timescale " + timescale(scale_.picoseconds) + " $end\n");
  buffer_.put("$scope module machine $end\n");
  for (unsigned m = 0; m < motors_; ++m) {
    const std::string letter(1, letter_of(options.motors[m].axis));
    put_variable(1, step_wire(m), letter + "_step");
    put_variable(1, direction_wire(m), letter + "_dir");
  }
  for (unsigned i = 0; i < switch_names.size(); ++i) put_variable(1, output_wire(i), switch_names[i]);
  put_variable(rpm_bits, output_wire(rpm_output), "spindle_rpm");
  const auto each_winding = [&](const auto& visit) {
    for (unsigned m = 0; windings_.exist() && m < motors_; ++m) {
      for (unsigned f = 0; f < TraceWindings::outputs; ++f) visit(m, f);
    }
  };
  each_winding([&](unsigned m, unsigned f) {
    const std::string name = {letter_of(options.motors[m].axis), '_', 'F', static_cast<char>('1' + f)};
    put_variable(1, winding_wire(m, f), name);
  });
  buffer_.put("$upscope $end\n$enddefinitions $end\n#0\n$dumpvars\n");
  for (unsigned wire = 0; wire < output_wire(rpm_output); ++wire) put_bit(wire, false);
  put_rpm(0);
  each_winding([&](unsigned m, unsigned f) { put_bit(winding_wire(m, f), false); });
  buffer_.put("$end\n");
}

unsigned TraceVcd::winding_wire(unsigned motor, unsigned output) const {
  return output_wire(rpm_output) + 1 + TraceWindings::outputs * motor + output;
}

void TraceVcd::put_variable(unsigned bits, unsigned wire, std::string_view name) {
  buffer_.make_room();
  buffer_.put("$var wire ");
  buffer_.put(std::uint64_t{bits});
  buffer_.put(' ');
  buffer_.put(static_cast<char>('!' + wire));
  buffer_.put(' ');
  buffer_.put(name);
  buffer_.put(" $end\n");
}

void TraceVcd::put_bit(unsigned wire, bool value) {
  buffer_.put(value ? '1' : '0');
  buffer_.put(static_cast<char>('!' + wire));
  buffer_.put('\n');
}

void TraceVcd::put_rpm(unsigned value) {
  buffer_.put('b');
  for (unsigned bit = rpm_bits; bit-- > 0;) buffer_.put((value >> bit & 1U) != 0 ? '1' : '0');
  buffer_.put(' ');
  buffer_.put(static_cast<char>('!' + output_wire(rpm_output)));
  buffer_.put('\n');
}

void TraceVcd::put_time(std::uint64_t time) {
  buffer_.make_room();
  if (time == now_) return;
  now_ = time;
  buffer_.put('#');
  buffer_.put(time);
  buffer_.put('\n');
}

void TraceVcd::close_pulse(std::uint64_t longest) {
  if (high_ == 0) return;
  put_time(rose_at_ + std::min(step_pulse_, longest));
  for (unsigned m = 0; m < motors_; ++m) {
    if ((high_ >> m & 1U) != 0) put_bit(step_wire(m), false);
  }
  high_ = 0;
}

void TraceVcd::on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) {
  const std::uint64_t at = scale_.units(static_cast<std::uint64_t>(time.count));
  close_pulse((at - rose_at_) / 2);
  put_time(at);
  const unsigned turned = (directions_ ^ directions) & stepped;
  directions_ ^= turned;
  for (unsigned m = 0; m < motors_; ++m) {
    if ((turned >> m & 1U) != 0) put_bit(direction_wire(m), (directions >> m & 1U) != 0);
    if ((stepped >> m & 1U) != 0) put_bit(step_wire(m), true);
    if ((stepped >> m & 1U) != 0 && windings_.exist()) {
      const unsigned switched = windings_.step(m, (directions >> m & 1U) != 0);
      for (unsigned f = 0; f < TraceWindings::outputs; ++f) {
        if ((switched >> f & 1U) != 0) put_bit(winding_wire(m, f), windings_.is_on(m, f));
      }
    }
  }
  high_ = stepped;
  rose_at_ = at;
}

void TraceVcd::on_outputs(Ticks time, const BoardOutputs& outputs) {
  const unsigned changed = outputs_.switches ^ outputs.switches;
  if (changed == 0 && outputs.spindle_rpm == outputs_.spindle_rpm) return;
  const std::uint64_t at = scale_.units(static_cast<std::uint64_t>(time.count));
  // A pulse that rises at the same time stays high.
  if (at > rose_at_) close_pulse((at - rose_at_) / 2);
  put_time(at);
  for (unsigned i = 0; i < switch_names.size(); ++i) {
    if ((changed >> i & 1U) != 0) put_bit(output_wire(i), (outputs.switches >> i & 1U) != 0);
  }
  if (outputs.spindle_rpm != outputs_.spindle_rpm) put_rpm(outputs.spindle_rpm);
  outputs_ = outputs;
}

void TraceVcd::finish(Ticks end) {
  close_pulse(step_pulse_);
  put_time(std::max(now_, scale_.units(static_cast<std::uint64_t>(end.count))));
  buffer_.flush();
}

}  // namespace passo
