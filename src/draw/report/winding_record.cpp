#include "passo/report/winding_record.hpp"

#include <cmath>
#include <iterator>

#include "phase_currents.hpp"
#include <fmt/format.h>

#include "passo/study/measure.hpp"

namespace passo {
namespace {

constexpr unsigned values_of_motor = winding_outputs + 4;  // F1 to F4, place, A, B, degrees

// The code of a value in the VCD: printable signs from '!' on, two of them.
std::string code(std::size_t motor, unsigned value) {
  const std::size_t number = motor * values_of_motor + value;
  return {static_cast<char>('!' + number / 90), static_cast<char>('!' + number % 90)};
}

}  // namespace

WindingCsv::WindingCsv(const WindingMotors& motors, OutputFile& file)
    : motors_(motors), file_(file), place_(motors.count, 0), currents_(std::make_unique<PhaseCurrents>(motors)) {
  std::string header = "t";
  for (std::size_t motor = 0; motor < motors.count; ++motor) {
    const std::string name = axis_name(motor);
    header += fmt::format(",{0},{0}_f1,{0}_f2,{0}_f3,{0}_f4,{0}_a,{0}_b,{0}_deg", name);
  }
  file_.write(header + "\n");
  put_row(Seconds(0));
}

WindingCsv::~WindingCsv() = default;

void WindingCsv::put_row(Seconds time) {
  std::string row = fmt::format("{:.9f}", time.value());
  for (std::size_t motor = 0; motor < motors_.count; ++motor) {
    const std::int64_t place = place_[motor];
    const WindingState state = motors_.excitation.at(place);
    const auto [a, b] = currents_->of(motor);
    fmt::format_to(std::back_inserter(row), ",{},{:d},{:d},{:d},{:d},{:.6g},{:.6g},{:.10g}", place, state.on(0),
                   state.on(1), state.on(2), state.on(3), a, b,
                   motors_.excitation.rotor_degrees(place, motors_.full_steps_per_turn));
  }
  file_.write(row + "\n");
}

void WindingCsv::add(const TimedPulse& pulse) {
  if (pulse.pulse.steps == 0) return;
  currents_->play(pulse.time, [&] { put_row(currents_->now()); });
  apply(pulse.pulse, place_);
  for (std::size_t motor = 0; motor < motors_.count; ++motor) currents_->move_to(motor, place_[motor]);
  put_row(pulse.time);
}

void WindingCsv::finish(Seconds /*end*/) {
  currents_->play_out([&] { put_row(currents_->now()); });
}

WindingVcd::WindingVcd(const WindingMotors& motors, OutputFile& file)
    : motors_(motors), file_(file), place_(motors.count, 0), currents_(std::make_unique<PhaseCurrents>(motors)) {
  std::string text = "$version Passo $end\n$timescale 1 ns $end\n$scope module windings $end\n";
  const auto out = std::back_inserter(text);
  for (std::size_t motor = 0; motor < motors.count; ++motor) {
    const std::string name = axis_name(motor);
    for (unsigned f = 0; f < winding_outputs; ++f) {
      fmt::format_to(out, "$var wire 1 {} {}_F{} $end\n", code(motor, f), name, f + 1);
    }
    fmt::format_to(out, "$var integer 32 {} {}_place $end\n", code(motor, winding_outputs), name);
    fmt::format_to(out, "$var real 64 {} {}_A $end\n", code(motor, winding_outputs + 1), name);
    fmt::format_to(out, "$var real 64 {} {}_B $end\n", code(motor, winding_outputs + 2), name);
    fmt::format_to(out, "$var real 64 {} {}_deg $end\n", code(motor, winding_outputs + 3), name);
  }
  text += "$upscope $end\n$enddefinitions $end\n#0\n$dumpvars\n";
  for (std::size_t motor = 0; motor < motors.count; ++motor) put_motor(text, motor);
  file_.write(text + "$end\n");
}

WindingVcd::~WindingVcd() = default;

void WindingVcd::put_motor(std::string& text, std::size_t motor) const {
  const std::int64_t place = place_[motor];
  const WindingState state = motors_.excitation.at(place);
  const auto out = std::back_inserter(text);
  for (unsigned f = 0; f < winding_outputs; ++f) fmt::format_to(out, "{:d}{}\n", state.on(f), code(motor, f));
  fmt::format_to(out, "b{:032b} {}\n", static_cast<std::uint32_t>(place), code(motor, winding_outputs));
  put_currents(text, motor);
  fmt::format_to(out, "r{:.10g} {}\n", motors_.excitation.rotor_degrees(place, motors_.full_steps_per_turn),
                 code(motor, winding_outputs + 3));
}

void WindingVcd::put_currents(std::string& text, std::size_t motor) const {
  const auto [a, b] = currents_->of(motor);
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "r{:.10g} {}\n", a, code(motor, winding_outputs + 1));
  fmt::format_to(out, "r{:.10g} {}\n", b, code(motor, winding_outputs + 2));
}

// Between two pulses: currents alone.
void WindingVcd::put_moment() {
  std::string text;
  put_time(text, currents_->now());
  for (std::size_t motor = 0; motor < motors_.count; ++motor) put_currents(text, motor);
  file_.write(text);
}

void WindingVcd::put_time(std::string& text, Seconds time) {
  const std::int64_t ns = std::llround(time.value() * 1e9);
  if (ns <= now_) return;
  now_ = ns;
  text += fmt::format("#{}\n", ns);
}

void WindingVcd::add(const TimedPulse& pulse) {
  if (pulse.pulse.steps == 0) return;
  currents_->play(pulse.time, [&] { put_moment(); });
  apply(pulse.pulse, place_);
  for (std::size_t motor = 0; motor < motors_.count; ++motor) currents_->move_to(motor, place_[motor]);
  std::string text;
  put_time(text, pulse.time);
  for (std::size_t motor = 0; motor < motors_.count; ++motor) {
    if ((pulse.pulse.steps >> motor & 1) != 0) put_motor(text, motor);
  }
  file_.write(text);
}

void WindingVcd::finish(Seconds end) {
  currents_->play_out([&] { put_moment(); });
  std::string text;
  put_time(text, end);
  file_.write(text);
}

}  // namespace passo
