#include "passo/report/trace_csv.hpp"

#include <cassert>
#include <cmath>
#include <utility>

namespace passo {
namespace {

char column(const TraceMotor& motor) {
  return static_cast<char>(letter_of(motor.axis) - 'A' + 'a');
}

}  // namespace

TraceCsv::TraceCsv(const TraceOptions& options, TraceSink sink)
    : buffer_(std::move(sink)),
      ticks_a_second_(static_cast<std::uint64_t>(std::llround(options.clock.value()))),
      motors_(static_cast<unsigned>(options.motors.size())),
      windings_(options.windings) {
  assert(motors_ <= max_motors);
  buffer_.put('t');
  for (unsigned m = 0; m < motors_; ++m) {
    const TraceMotor& motor = options.motors[m];
    buffer_.put(',');
    buffer_.put(column(motor));
    if (motor.inverted) inverted_ = static_cast<std::uint8_t>(inverted_ | 1U << m);
  }
  for (unsigned m = 0; windings_.exist() && m < motors_; ++m) {
    for (unsigned f = 0; f < TraceWindings::outputs; ++f) {
      for (const char letter : {',', column(options.motors[m]), '_', 'f', static_cast<char>('1' + f)}) {
        buffer_.put(letter);
      }
    }
  }
  buffer_.put('\n');
}

void TraceCsv::on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) {
  buffer_.make_room();
  put_seconds(static_cast<std::uint64_t>(time.count));
  const unsigned down = directions ^ inverted_;
  for (unsigned m = 0; m < motors_; ++m) {
    buffer_.put(',');
    if ((stepped & down) >> m & 1U) buffer_.put('-');
    buffer_.put(static_cast<char>('0' + (stepped >> m & 1U)));
  }
  if (windings_.exist()) put_windings(stepped, directions);
  buffer_.put('\n');
}

void TraceCsv::put_windings(std::uint8_t stepped, std::uint8_t directions) {
  for (unsigned m = 0; m < motors_; ++m) {
    if ((stepped >> m & 1U) != 0) windings_.step(m, (directions >> m & 1U) != 0);
    for (unsigned f = 0; f < TraceWindings::outputs; ++f) {
      buffer_.put(',');
      buffer_.put(windings_.is_on(m, f) ? '1' : '0');
    }
  }
}

void TraceCsv::put_seconds(std::uint64_t ticks) {
  std::uint64_t rest = ticks - second_start_;
  if (rest >= ticks_a_second_) {
    second_ += rest / ticks_a_second_;
    rest %= ticks_a_second_;
    second_start_ = ticks - rest;
  }
  constexpr std::uint64_t billion = 1'000'000'000;
  const std::uint64_t nanoseconds = (2 * rest * billion + ticks_a_second_) / (2 * ticks_a_second_);
  const std::uint64_t carry = nanoseconds == billion ? 1 : 0;
  buffer_.put(second_ + carry);
  buffer_.put_decimals(carry != 0 ? 0 : nanoseconds);
}

void TraceCsv::finish(Ticks /*end*/) {
  buffer_.flush();
}

}  // namespace passo
