// The registers of the parallel port against a table of the connector: pin, register, bit, inverted.
#include "passo/port/parallel_port.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

using Register = ParallelPort::Register;

struct Row {
  int pin;
  Register of;
  unsigned bit;
  bool inverted;
};
constexpr Row connector[] = {
    {2, Register::data, 0, false},     {3, Register::data, 1, false},    {4, Register::data, 2, false},
    {5, Register::data, 3, false},     {6, Register::data, 4, false},    {7, Register::data, 5, false},
    {8, Register::data, 6, false},     {9, Register::data, 7, false},    {15, Register::status, 3, false},
    {13, Register::status, 4, false},  {12, Register::status, 5, false}, {10, Register::status, 6, false},
    {11, Register::status, 7, true},   {1, Register::control, 0, true},  {14, Register::control, 1, true},
    {16, Register::control, 2, false}, {17, Register::control, 3, true}};

TEST(ParallelPort, a_bit_of_an_output_register_drives_its_pin_and_no_other) {
  for (const Row& row : connector) {
    if (row.of == Register::status) continue;
    for (const bool set : {false, true}) {
      ParallelPort port;
      ParallelPort reference;
      // All other bits of the register are the opposite.
      const auto mask = static_cast<std::uint8_t>(1U << row.bit);
      reference.write(row.of, set ? 0 : 0xff);
      port.write(row.of, set ? mask : static_cast<std::uint8_t>(~mask));
      for (int pin = 1; pin <= ParallelPort::pin_count; ++pin) {
        if (pin == row.pin) {
          EXPECT_EQ(port.level(pin), set != row.inverted) << "pin " << pin;
        } else {
          EXPECT_EQ(port.level(pin), reference.level(pin)) << "pin " << pin << " with pin " << row.pin;
        }
      }
    }
  }
}

TEST(ParallelPort, an_input_pin_shows_in_its_bit_of_the_status_register) {
  for (const Row& row : connector) {
    if (row.of != Register::status) continue;
    ParallelPort port;
    const std::uint8_t before = port.read(Register::status);
    port.set_input(row.pin, true);
    EXPECT_TRUE(port.level(row.pin));
    EXPECT_EQ(port.read(Register::status) ^ before, 1U << row.bit) << "pin " << row.pin;
    EXPECT_EQ((port.read(Register::status) >> row.bit & 1) != 0, !row.inverted) << "pin " << row.pin;
    port.set_input(row.pin, false);
    EXPECT_EQ(port.read(Register::status), before);
  }
}

TEST(ParallelPort, control_pins_except_16_are_high_after_a_zero) {
  ParallelPort port;
  port.write(Register::control, 0);
  EXPECT_TRUE(port.level(1));
  EXPECT_TRUE(port.level(14));
  EXPECT_FALSE(port.level(16));
  EXPECT_TRUE(port.level(17));
}

TEST(ParallelPort, inputs_outputs_and_ground_do_not_change_from_the_other_side) {
  ParallelPort port;
  port.write(Register::status, 0x55);
  for (const int pin : {10, 11, 12, 13, 15}) EXPECT_FALSE(port.level(pin));
  for (const int pin : {2, 16, 18, 25, 0, 26}) {
    port.set_input(pin, true);
    EXPECT_FALSE(port.level(pin));
  }
  for (int pin = 18; pin <= 25; ++pin) EXPECT_EQ(ParallelPort::bit_of(pin), std::nullopt);
  EXPECT_EQ(port.read(Register::data), 0);
  port.write(Register::control, 0xff);
  EXPECT_EQ(port.read(Register::control), 0x0f);
}

}  // namespace
}  // namespace passo
