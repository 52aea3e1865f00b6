#include "passo/link/twin_motors.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr std::uint8_t first_switch = 2;
constexpr std::uint8_t second_switch = 8;

TwinMotors twins(bool opposite = false) {
  TwinMotors all;
  all.set(
      {{.first = 1, .second = 3, .opposite = opposite, .first_switch = first_switch, .second_switch = second_switch}});
  return all;
}

// Motor 0 up, motor 1 down at every event and a half.
const BoardSegment planned{
    .events = 9, .directions = 2, .flips = 2, .interval = 1 << 20, .increments = {1000, 0x8000, 3000}};

TEST(TwinMotors, step_together) {
  const BoardSegment sent = twins().for_board(planned);
  EXPECT_EQ(sent.increments[3], 0x8000);
  EXPECT_EQ(sent.flips, 2 | 8);
  EXPECT_EQ(sent.directions, 2 | 8);
  EXPECT_EQ(sent.increments[1], 0x8000);
  EXPECT_EQ(sent.increments[0], 1000);
  EXPECT_EQ(twins(true).for_board(planned).directions, 2) << "the second motor faces the first";
}

TEST(TwinMotors, step_alone_while_one_switch_of_theirs_is_watched) {
  TwinMotors all = twins();
  all.watch(first_switch);
  EXPECT_EQ(all.for_board(planned).increments[3], 0);
  EXPECT_EQ(all.for_board(planned).flips, 2);
  all.watch(second_switch);
  EXPECT_EQ(all.for_board(planned).increments[1], 0);
  EXPECT_EQ(all.for_board(planned).flips, 8);
  EXPECT_EQ(all.for_board(planned).increments[2], 3000);
  for (const std::uint8_t both : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{first_switch | second_switch}}) {
    all.watch(both);
    EXPECT_EQ(all.for_board(planned).flips, 2 | 8);
  }
}

TEST(TwinMotors, are_one_motor_to_the_host_which_goes_on_from_where_it_was) {
  TwinMotors all = twins(true);
  const auto host_count = [&](std::int32_t first, std::int32_t second) {
    std::int32_t counts[max_motors] = {7, first, 9, second};
    all.for_host(counts);
    EXPECT_EQ(counts[0], 7);
    EXPECT_EQ(counts[3], second) << "the board's own";
    return counts[1];
  };
  EXPECT_EQ(host_count(100, -40), 100);
  std::int32_t rest[max_motors] = {0, 100, 0, -40};
  all.watch(second_switch);
  EXPECT_EQ(host_count(100, -40), 100) << "nothing has been counted under the new watch yet";
  all.settle(rest);
  EXPECT_EQ(host_count(100, -40), 100);
  EXPECT_EQ(host_count(100, -50), 110) << "the second motor alone";
  rest[3] = -50;
  all.watch(0);
  all.settle(rest);
  EXPECT_EQ(host_count(100, -50), 110);
  EXPECT_EQ(host_count(95, -45), 105) << "both";
  std::int32_t told[max_motors] = {0, 105};
  EXPECT_TRUE(all.forget_shifts(told));
  EXPECT_EQ(told[1], 95);
  EXPECT_EQ(host_count(95, -45), 95);
  EXPECT_FALSE(all.forget_shifts(told));
}

}  // namespace
}  // namespace passo
