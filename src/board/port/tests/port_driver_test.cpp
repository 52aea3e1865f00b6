#include "passo/port/port_driver.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace passo {
namespace {

using Register = ParallelPort::Register;
using Writes = std::vector<PortWrite>;

TEST(PortDriver, a_step_sets_the_direction_then_raises_and_lowers_the_clock) {
  PortDriver driver(75'000);
  driver.step(1'000'000, 0b001, 0b001);
  EXPECT_EQ(driver.take(10'000'000), (Writes{{1'000'000, Register::data, 0b001000},
                                             {1'075'000, Register::data, 0b001001},
                                             {1'150'000, Register::data, 0b001000}}));
  // The direction stays, so the next step in it takes two writes.
  driver.step(20'000'000, 0b001, 0b001);
  EXPECT_EQ(driver.take(30'000'000).size(), 2U);
}

TEST(PortDriver, motors_that_step_together_share_their_writes) {
  PortDriver driver(75'000);
  driver.step(0, 0b111, 0b100);
  EXPECT_EQ(
      driver.take(1'000'000),
      (Writes{{0, Register::data, 0b100000}, {75'000, Register::data, 0b100111}, {150'000, Register::data, 0b100000}}));
}

// The first step's clock falls as the second one's direction changes: one write does both.
TEST(PortDriver, the_next_step_may_begin_as_the_last_one_ends) {
  PortDriver driver(75'000);
  driver.step(0, 0b010, 0);
  driver.step(150'000, 0b010, 0b010);
  EXPECT_EQ(driver.take(1'000'000), (Writes{{75'000, Register::data, 0b000010},
                                            {150'000, Register::data, 0b010000},
                                            {225'000, Register::data, 0b010010},
                                            {300'000, Register::data, 0b010000}}));
}

TEST(PortDriver, writes_are_the_same_however_they_are_taken) {
  Writes whole;
  Writes pieces;
  PortDriver one(75'000);
  PortDriver other(75'000);
  for (std::int64_t i = 0; i < 200; ++i) {
    const std::int64_t at = i * 151'700;
    const auto stepped = static_cast<unsigned>(1 + i % 7);
    const auto down = static_cast<unsigned>(i / 9 % 8);
    one.step(at, stepped, down);
    other.step(at, stepped, down);
    if (i % 13 == 0) {
      one.switch_tool(at, i % 26 == 0);
      other.switch_tool(at, i % 26 == 0);
    }
    for (const PortWrite& write : other.take(at)) pieces.push_back(write);
  }
  whole = one.take(1'000'000'000);
  for (const PortWrite& write : other.take(1'000'000'000)) pieces.push_back(write);
  EXPECT_EQ(whole, pieces);
  EXPECT_GT(whole.size(), 400U);
}

// Clock Z on pin 1 and the tool on pin 17, which the port inverts: the driver writes the opposite bits.
TEST(PortDriver, signals_may_be_on_inverted_pins_of_the_control_register) {
  PortDriver driver(1'000, {.clock = {2, 3, 1}, .direction = {5, 6, 7}, .tool = 17});
  driver.step(0, 0b100, 0);
  driver.switch_tool(5'000, true);
  const Writes writes = driver.take(10'000);
  EXPECT_EQ(writes, (Writes{{0, Register::control, 0b1001},
                            {1'000, Register::control, 0b1000},
                            {2'000, Register::control, 0b1001},
                            {5'000, Register::control, 0b0001}}));
  ParallelPort port;
  std::vector<std::pair<bool, bool>> levels;
  for (const PortWrite& write : writes) {
    port.write(write.to, write.value);
    levels.emplace_back(port.level(1), port.level(17));
  }
  EXPECT_EQ(levels, (std::vector<std::pair<bool, bool>>{{false, false}, {true, false}, {false, false}, {false, true}}));
}

}  // namespace
}  // namespace passo
