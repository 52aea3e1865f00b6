#include "passo/plant/ideal_plant.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "kit/seed.hpp"

#include "passo/wire/message.hpp"

namespace passo {
namespace {

constexpr Seconds now{0};

TEST(IdealPlant, stands_where_it_is_told_to_go) {
  IdealPlant plant;
  plant.stand_at({100, -20});
  plant.pulse(now, {5, 3});
  plant.pulse(now, {-8, 0, 1});
  const Truth truth = plant.truth_at(now);
  EXPECT_EQ(truth.positions, (MotorPositions{97, -17, 1}));
  EXPECT_EQ(truth.inputs, 0);
  EXPECT_EQ(truth.spindle_turns, 0);
  EXPECT_EQ(plant.events_to_next_change(), Plant::never) << "nothing hangs on its motors";
}

TEST(IdealPlant, a_travel_switch_closes_at_its_place_and_opens_later) {
  IdealPlant plant;
  plant.add(TravelSwitch{.input = input_limit, .motor = 1, .at_high_end = true, .closes_at = 120, .opens_at = 110});
  EXPECT_EQ(plant.events_to_next_change(), 120);
  plant.pulse(now, {0, 119});
  EXPECT_EQ(plant.inputs_at(now), 0);
  EXPECT_EQ(plant.events_to_next_change(), 1);
  plant.pulse(now, {0, 1});
  EXPECT_EQ(plant.inputs_at(now), input_limit);
  EXPECT_EQ(plant.truth_at(now).inputs, input_limit);
  EXPECT_EQ(plant.events_to_next_change(), 10);
  plant.pulse(now, {0, -9});
  EXPECT_EQ(plant.inputs_at(now), input_limit);
  plant.pulse(now, {0, -1});
  EXPECT_EQ(plant.inputs_at(now), 0);
}

TEST(IdealPlant, a_contact_that_bounces_comes_to_rest_in_its_time) {
  IdealPlant plant;
  plant.add(TravelSwitch{
      .input = input_limit, .at_high_end = true, .closes_at = 20, .opens_at = 10, .bounce = Seconds(10e-3)});
  plant.pulse(Seconds(1), {19});
  EXPECT_EQ(plant.inputs_at(Seconds(1)), 0);
  EXPECT_EQ(plant.events_to_next_change(), 1);
  for (const auto& [pulses, closed] : {std::pair{1, true}, std::pair{-10, false}}) {
    const double from = closed ? 2 : 3;
    plant.pulse(Seconds(from), {pulses});
    EXPECT_EQ(plant.inputs_at(Seconds(from)) != 0, closed) << "its first edge is the place of the contact";
    int edges = 0;
    bool before = closed;
    for (int ms_100 = 1; ms_100 < 2000; ++ms_100) {
      const Seconds time(from + ms_100 * 1e-5);
      const bool now_closed = plant.inputs_at(time) != 0;
      if (now_closed != before) ++edges;
      before = now_closed;
      if (ms_100 == 500) {
        EXPECT_EQ(plant.events_to_next_change(), 1) << "every event counts";
      }
      if (ms_100 >= 1000) {
        EXPECT_EQ(now_closed, closed);
      }
    }
    EXPECT_EQ(edges, 6);
  }
  EXPECT_EQ(plant.truth_at(Seconds(4)).positions[0], 10);
  EXPECT_EQ(plant.events_to_next_change(), 10) << "at rest";
}

TEST(IdealPlant, its_probe_touches_a_body_while_all_motors_are_in_it) {
  IdealPlant plant;
  TouchBody body;
  body.motors[0] = {.low = 10, .high = 20};
  body.motors[2] = {.low = -5, .high = INT64_MAX};
  plant.stand_at({0, 0, -30});
  plant.add(body);
  EXPECT_EQ(plant.events_to_next_change(), 25) << "the furthest motor's way";
  plant.pulse(now, {12, 0, 24});
  EXPECT_EQ(plant.inputs_at(now), 0);
  plant.pulse(now, {0, 0, 1});
  EXPECT_EQ(plant.inputs_at(now), input_probe);
  EXPECT_EQ(plant.events_to_next_change(), 1);
  plant.pulse(now, {5, 0, 40});
  EXPECT_EQ(plant.events_to_next_change(), 4) << "the nearest side";
  plant.pulse(now, {4, 0, 0});
  EXPECT_EQ(plant.inputs_at(now), 0);
}

TEST(IdealPlant, an_input_is_open_when_all_that_close_it_are) {
  IdealPlant plant;
  plant.add(TravelSwitch{.input = input_limit, .motor = 0, .at_high_end = true, .closes_at = 5, .opens_at = 5});
  plant.add(TravelSwitch{.input = input_limit, .motor = 1, .closes_at = -5, .opens_at = -5});
  plant.pulse(now, {5, -5});
  plant.set_switch(input_limit | input_hold, true);
  EXPECT_EQ(plant.inputs_at(now), input_limit | input_hold);
  plant.set_switch(input_limit, false);
  EXPECT_EQ(plant.inputs_at(now), input_limit | input_hold);
  plant.pulse(now, {-1});
  EXPECT_EQ(plant.inputs_at(now), input_limit | input_hold);
  plant.pulse(now, {0, 1});
  EXPECT_EQ(plant.inputs_at(now), input_hold);
}

TEST(IdealPlant, its_spindle_turns_as_commanded) {
  IdealPlant plant;
  plant.command_spindle(Seconds(1), -600);
  EXPECT_DOUBLE_EQ(plant.truth_at(Seconds(3)).spindle_turns, -20);
  EXPECT_FALSE(plant.spindle().has_encoder());
  plant.fit_spindle({.counts_per_turn = 100, .run_up = 0.6});
  plant.command_spindle(Seconds(0), 1000);
  EXPECT_DOUBLE_EQ(plant.truth_at(Seconds(0.6)).spindle_turns, 5);
  EXPECT_EQ(plant.spindle().counts_per_turn(), 100);
  EXPECT_EQ(plant.spindle().count_at(Seconds(0.6)).count, 500U);
}

IdealPlant random_plant(std::mt19937_64& random) {
  const auto within = [&](std::int64_t most) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * most + 1)) - most;
  };
  IdealPlant plant;
  for (int i = 0; i < 3; ++i) {
    const bool high = random() % 2 == 0;
    const std::int64_t closes = within(60);
    const auto later = static_cast<std::int64_t>(random() % 3) * 5;
    plant.add(TravelSwitch{.input = static_cast<std::uint16_t>(1U << random() % 3),
                           .motor = static_cast<std::uint8_t>(random() % 3),
                           .at_high_end = high,
                           .closes_at = closes,
                           .opens_at = high ? closes - later : closes + later});
    TouchBody body;
    for (std::size_t m = 0; m < 3; ++m) {
      if (random() % 2 == 0) body.motors[m].low = within(60);
      if (random() % 2 == 0) body.motors[m].high = within(60);
    }
    plant.add(body);
  }
  return plant;
}

// A board that keeps sums back misses no change: its inputs are those of a board that gives each pulse.
TEST(IdealPlant, sums_up_to_the_next_change_tell_it_as_much_as_each_pulse) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::int64_t kept = 0;
  for (int trial = 0; trial < 100; ++trial) {
    IdealPlant each = random_plant(random);
    IdealPlant sums = each;
    MotorSteps sum{};
    std::int64_t quiet = sums.events_to_next_change();
    MotorSteps way{};
    for (int event = 0; event < 2000; ++event) {
      MotorSteps steps{};
      for (std::size_t m = 0; m < 3; ++m) {
        if (random() % 50 == 0) way[m] = static_cast<std::int64_t>(random() % 3) - 1;
        steps[m] = random() % 4 == 0 ? 0 : way[m];
        sum[m] += steps[m];
      }
      each.pulse(now, steps);
      ASSERT_GE(quiet, 1);
      if (--quiet == 0) {
        sums.pulse(now, sum);
        sum = {};
        quiet = sums.events_to_next_change();
      } else {
        ++kept;
      }
      ASSERT_EQ(each.inputs_at(now), sums.inputs_at(now)) << "event " << event << " of trial " << trial;
    }
    sums.pulse(now, sum);
    EXPECT_EQ(each.truth_at(now).positions, sums.truth_at(now).positions);
  }
  EXPECT_GT(kept, 0);
}

}  // namespace
}  // namespace passo
