#include "passo/port/parallel_port.hpp"

#include <array>

namespace passo {
namespace {

using Register = ParallelPort::Register;
using Bit = ParallelPort::Bit;

// Pins 1 to 17.
constexpr std::array<Bit, 17> bits{{{Register::control, 0, true},
                                    {Register::data, 0},
                                    {Register::data, 1},
                                    {Register::data, 2},
                                    {Register::data, 3},
                                    {Register::data, 4},
                                    {Register::data, 5},
                                    {Register::data, 6},
                                    {Register::data, 7},
                                    {Register::status, 6},
                                    {Register::status, 7, true},
                                    {Register::status, 5},
                                    {Register::status, 4},
                                    {Register::control, 1, true},
                                    {Register::status, 3},
                                    {Register::control, 2},
                                    {Register::control, 3, true}}};
constexpr std::uint8_t bits_of_control = 0x0f;

}  // namespace

std::optional<Bit> ParallelPort::bit_of(int pin) {
  if (pin < 1 || pin > static_cast<int>(bits.size())) return {};
  return bits[static_cast<std::size_t>(pin) - 1];
}

std::uint8_t& ParallelPort::latch_of(Register which) {
  return which == Register::data ? data_ : which == Register::status ? status_ : control_;
}

void ParallelPort::write(Register to, std::uint8_t value) {
  if (to == Register::data) data_ = value;
  if (to == Register::control) control_ = value & bits_of_control;
}

std::uint8_t ParallelPort::read(Register from) const {
  return from == Register::data ? data_ : from == Register::status ? status_ : control_;
}

bool ParallelPort::level(int pin) const {
  const auto bit = bit_of(pin);
  if (!bit) return false;
  return ((read(bit->of) >> bit->number & 1) != 0) != bit->inverted;
}

void ParallelPort::set_input(int pin, bool high) {
  const auto bit = bit_of(pin);
  if (!bit || bit->of != Register::status) return;
  const auto mask = static_cast<std::uint8_t>(1U << bit->number);
  std::uint8_t& latch = latch_of(bit->of);
  latch = static_cast<std::uint8_t>(high != bit->inverted ? latch | mask : latch & ~mask);
}

}  // namespace passo
