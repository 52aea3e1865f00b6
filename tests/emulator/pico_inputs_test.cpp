// The switches of the emulated Pico while its motors turn: what stops them, how soon, and what place the probe is told
// at.
#include <algorithm>
#include <cstdlib>
#include <optional>
#include <random>

#include "emulator/pico_bench.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

class PicoInputs : public ::testing::Test {
 protected:
  void SetUp() override {
    static const std::string why = PicoBench::missing(PASSO_MOTION_PICO);
    if (!why.empty()) GTEST_SKIP() << why;
  }
};

constexpr std::uint8_t motors = 3;
// From a switch to what it does: the interrupt's way. A tick of the board has eight cycles.
constexpr std::uint64_t latency = 100;
constexpr std::uint32_t interval = 40;  // ticks: 400,000 events a second

// All motors step at every event, one of them back.
std::vector<PicoBench::Item> long_run(int segments) {
  std::vector<PicoBench::Item> items;
  for (int i = 0; i < segments; ++i) {
    items.emplace_back(BoardSegment{.events = 2'000, .directions = 2, .flips = 7, .interval = interval << 16});
  }
  return items;
}

// Where a motor stands by its pins, at a cycle and from the start of the changes.
std::int32_t place_at(const std::vector<SeenSteps>& seen, std::size_t motor, std::uint64_t cycle) {
  std::int32_t place = 0;
  for (const SeenStep& step : seen[motor]) {
    if (step.time <= static_cast<std::int64_t>(cycle)) place += step.down ? -1 : 1;
  }
  return place;
}

std::uint64_t last_step(const std::vector<SeenSteps>& seen) {
  std::int64_t last = 0;
  for (const SeenSteps& one : seen) last = std::max(last, one.empty() ? 0 : one.back().time);
  return static_cast<std::uint64_t>(last);
}

void expect_stop(PicoBench& bench, std::mt19937_64& random, std::uint8_t gpio, FaultReason reason) {
  EdgeCheck ignored;
  bench.press(0);
  bench.ask();
  bench.run(pico_clock_rate / 100);
  ASSERT_TRUE(bench.status().has_value());
  const std::vector<std::int32_t> before(bench.status()->positions, bench.status()->positions + motors);
  std::vector<PicoBench::Item> items = {BoardOutputs{.switches = flood_on | spindle_on, .spindle_rpm = 12'000}};
  for (const PicoBench::Item& item : long_run(20)) items.push_back(item);
  bench.start(items);
  bench.run(pico_clock_rate / 50, gpio_bit(pico_bare.motor[0].step), 3'000);
  EXPECT_NE(bench.levels() & gpio_bit(pico_bare.flood), 0U);
  EXPECT_NEAR(bench.duty(), 0.5, 0.01);
  bench.run(random() % (interval * pico_cycles_of_tick));
  const std::uint64_t closed = bench.pico().cycle();
  bench.press(gpio_bit(gpio));
  bench.run(pico_clock_rate / 500);
  bench.ask();
  bench.run(pico_clock_rate / 500);
  const std::vector<SeenSteps> seen = bench.seen(ignored);
  EXPECT_LE(last_step(seen), closed + latency) << "no step begins after it";
  EXPECT_GE(last_step(seen) + 2 * interval * pico_cycles_of_tick, closed) << "the motors turned until then";
  ASSERT_TRUE(bench.fault().has_value());
  EXPECT_EQ(bench.fault()->reason, reason);
  ASSERT_TRUE(bench.status().has_value());
  EXPECT_EQ(bench.status()->state & board_trusted, 0);
  for (std::size_t m = 0; m < motors; ++m) {
    EXPECT_EQ(bench.status()->positions[m] - before[m], place_at(seen, m, ~std::uint64_t{0} >> 1)) << "motor " << m;
  }
  const std::uint32_t levels = bench.levels();
  const std::uint32_t steps = std::uint32_t{pico_bare.steps_of(0xff)} << pico_bare.first;
  EXPECT_EQ(levels & (steps | gpio_bit(pico_bare.flood)), 0U) << "outputs are off, and no pulse hangs";
  EXPECT_EQ(bench.duty(), 0);
  const bool drivers_off = (levels & gpio_bit(pico_bare.enable)) != 0;
  EXPECT_EQ(drivers_off, reason == FaultReason::emergency_stop);
}

TEST_F(PicoInputs, limits_and_the_emergency_stop_stop_before_the_next_step) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.start({});
  for (const std::uint8_t limit : pico_bare.limits) expect_stop(bench, random, limit, FaultReason::limit);
  for (int i = 0; i < 3; ++i) expect_stop(bench, random, pico_bare.emergency_stop, FaultReason::emergency_stop);
}

// Spikes of 3 and 25 us at the switches, in motion: they stop the motors only without a filter. A switch that truly
// closes stops them after the filter's time, and at most a quarter of a millisecond later.
void expect_spikes(std::mt19937_64& random, std::uint8_t filter) {
  constexpr std::uint64_t microsecond = pico_clock_rate / 1'000'000;
  const std::uint32_t pins[] = {gpio_bit(pico_bare.limits[0]), gpio_bit(pico_bare.limits[2]),
                                gpio_bit(pico_bare.emergency_stop)};
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.set_up({.filter = filter});
  bench.start(long_run(20));
  bench.run(pico_clock_rate / 50, gpio_bit(pico_bare.motor[0].step), 3'000);
  for (int i = 0; i < 40 && !bench.fault(); ++i) {
    bench.run(random() % (200 * microsecond));
    bench.press(pins[random() % std::size(pins)]);
    bench.run((i % 2 == 0 ? 3 : 25) * microsecond);
    bench.press(0);
  }
  bench.run(500 * microsecond);
  if (filter == 0) {
    EXPECT_TRUE(bench.fault().has_value()) << "else the spikes prove nothing";
    return;
  }
  ASSERT_FALSE(bench.fault().has_value());
  const std::uint64_t closed = bench.pico().cycle();
  bench.press(pins[0]);
  bench.run(2'000 * microsecond);
  ASSERT_TRUE(bench.fault().has_value());
  EXPECT_EQ(bench.fault()->reason, FaultReason::limit);
  EdgeCheck ignored;
  const std::uint64_t last = last_step(bench.seen(ignored));
  EXPECT_GE(last, closed + (filter - 20U) * microsecond);
  EXPECT_LE(last, closed + (filter + 250U) * microsecond);
}

TEST_F(PicoInputs, a_filter_lets_spikes_pass_and_a_switch_stop_the_motors) {
  std::mt19937_64 random(test::seed());
  expect_spikes(random, 0);
  expect_spikes(random, 100);
}

// Everything that can be the other way round.
constexpr PinSetup inverted{.inputs = input_limit * 7 | input_probe | input_emergency_stop | input_hold | input_start,
                            .steps = 0x3f,
                            .outputs = spindle_on | spindle_reverse | mist_on | flood_on | inverted_enable,
                            .drivers_rest = 5};

TEST_F(PicoInputs, inverted_pins_do_what_the_others_do) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.set_up(inverted);
  ASSERT_TRUE(bench.made().has_value());
  PinSetup made = *bench.made();
  EXPECT_GT(made.timing.event_ticks, 0) << "it tells the times that it makes";
  made.timing = inverted.timing;
  EXPECT_EQ(made, inverted);
  bench.start({});
  expect_stop(bench, random, pico_bare.limits[1], FaultReason::limit);
  expect_stop(bench, random, pico_bare.emergency_stop, FaultReason::emergency_stop);
}

TEST_F(PicoInputs, inverted_steps_come_at_their_very_ticks) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, motors);
  PinSetup steps{.steps = 5};
  bench.set_up(steps);
  const StreamKind kind{.shortest_interval = 60, .longest_interval = 90, .shortest_segment = 100, .segments = 10};
  EdgeCheck check = bench.play(random_stream(random, motors, kind));
  EXPECT_TRUE(check.exact());
  EXPECT_EQ(check.error, 0);
  EXPECT_LE(check.longest_pulse, 256U) << "the motors rest at the level that is off";
}

TEST_F(PicoInputs, drivers_go_off_when_the_host_is_silent_for_as_long_as_the_setup_says) {
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.set_up({.outputs = inverted_enable, .drivers_rest = 5});
  bench.start({});
  bench.run(pico_clock_rate / 10 * 4);
  EXPECT_EQ(bench.levels() & gpio_bit(pico_bare.enable), 0U) << "on: low, as usual";
  bench.run(pico_clock_rate / 10 * 2);
  EXPECT_NE(bench.levels() & gpio_bit(pico_bare.enable), 0U);
  bench.ask();
  bench.run(pico_clock_rate / 500);
  ASSERT_TRUE(bench.status().has_value());
  EXPECT_EQ(bench.status()->state & board_trusted, 0);
}

// Opens and closes a pin again and again while the motors turn.
void expect_captures(PicoBench& bench, std::mt19937_64& random, std::uint8_t gpio, std::uint16_t input) {
  bench.run(pico_clock_rate / 100, gpio_bit(pico_bare.motor[0].step), 1'000);
  bool low = false;
  for (int change = 0; change < 12; ++change) {
    bench.run(random() % (interval * pico_cycles_of_tick));
    const std::uint64_t moved = bench.pico().cycle();
    low = !low;
    bench.press(low ? gpio_bit(gpio) : 0);
    bench.run(pico_clock_rate / 1000);
    ASSERT_TRUE(bench.captured().has_value());
    EXPECT_EQ(bench.captured()->input, low ? input : input | captured_released);
    EdgeCheck ignored;
    const std::vector<SeenSteps> seen = bench.seen(ignored);
    for (std::size_t m = 0; m < motors; ++m) {
      const std::int32_t told = bench.captured()->positions[m];
      const auto [least, most] = std::minmax({place_at(seen, m, moved), place_at(seen, m, moved + latency)});
      EXPECT_TRUE(told >= least && told <= most)
          << "motor " << m << ": told " << told << ", was at " << place_at(seen, m, moved);
    }
  }
  EXPECT_FALSE(bench.fault().has_value());
}

TEST_F(PicoInputs, the_probe_tells_the_place_of_the_very_event) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.start(long_run(10));
  expect_captures(bench, random, pico_bare.probe, input_probe);
}

TEST_F(PicoInputs, the_limit_switch_that_is_watched_captures_instead_of_stopping) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.start(long_run(10), 2);
  expect_captures(bench, random, pico_bare.limits[1], input_limit << 1U);
  // All others stop.
  bench.press(gpio_bit(pico_bare.limits[0]));
  bench.run(pico_clock_rate / 500);
  ASSERT_TRUE(bench.fault().has_value());
  EXPECT_EQ(bench.fault()->reason, FaultReason::limit);
}

// Two motors seek two switches: the first that closes counts, and then only when both are open again. The board names
// those that changed then.
TEST_F(PicoInputs, several_switches_are_watched_as_one) {
  PicoBench bench(PASSO_MOTION_PICO, motors);
  constexpr std::uint16_t one = input_limit;
  constexpr std::uint16_t other = input_limit << 2;
  bench.set_up({.inputs = other});
  bench.start(long_run(20), 5);
  const std::uint32_t first = gpio_bit(pico_bare.limits[0]);
  const std::uint32_t second = gpio_bit(pico_bare.limits[2]);
  bench.run(pico_clock_rate / 100, gpio_bit(pico_bare.motor[0].step), 1'000);
  EdgeCheck ignored;
  std::int32_t told = 0;
  const auto press = [&](std::uint32_t gpios, std::optional<std::uint16_t> captured) {
    const std::uint64_t moved = bench.pico().cycle();
    bench.forget_captured();
    bench.press(gpios);
    bench.run(pico_clock_rate / 1000);
    ASSERT_EQ(bench.captured().has_value(), captured.has_value()) << gpios;
    if (!captured) return;
    EXPECT_EQ(bench.captured()->input, *captured);
    told = bench.captured()->positions[0];
    const std::vector<SeenSteps> seen = bench.seen(ignored);
    EXPECT_GE(told, place_at(seen, 0, moved));
    EXPECT_LE(told, place_at(seen, 0, moved + latency));
  };
  press(second, other);
  press(first | second, std::nullopt);
  press(first, std::nullopt);
  bench.ask();
  bench.run(pico_clock_rate / 1000);
  ASSERT_TRUE(bench.status().has_value());
  EXPECT_EQ(bench.status()->inputs & (one | other), one) << "amid the motion";
  press(0, one | captured_released);
  press(first | second, one | other);
  press(second, std::nullopt);
  press(0, other | captured_released);
  EXPECT_FALSE(bench.fault().has_value());
}

TEST_F(PicoInputs, a_switch_that_is_closed_when_motion_begins_stops_it_at_once) {
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.start({});
  bench.press(gpio_bit(pico_bare.limits[0]));
  bench.run(pico_clock_rate / 100);
  bench.start(long_run(5));
  bench.run(pico_clock_rate / 100);
  ASSERT_TRUE(bench.fault().has_value());
  EXPECT_EQ(bench.fault()->reason, FaultReason::limit);
  EdgeCheck ignored;
  for (const SeenSteps& steps : bench.seen(ignored)) EXPECT_TRUE(steps.empty());
}

TEST_F(PicoInputs, outputs_go_off_one_by_one_when_the_host_is_silent) {
  PicoBench bench(PASSO_MOTION_PICO, motors);
  bench.start({});
  std::uint8_t frame[largest_frame];
  const Session session{.number = 7, .silence = {.spindle = 5, .mist = 0, .flood = 8}};
  bench.send({frame, encode(session, 0, frame)});
  bench.start({BoardOutputs{.switches = flood_on | mist_on | spindle_on, .spindle_rpm = 12'000}});
  bench.run(pico_clock_rate / 10 * 4);
  EXPECT_NEAR(bench.duty(), 0.5, 0.01);
  bench.run(pico_clock_rate / 10 * 3);
  EXPECT_EQ(bench.duty(), 0);
  EXPECT_NE(bench.levels() & gpio_bit(pico_bare.flood), 0U);
  bench.run(pico_clock_rate / 10 * 3);
  EXPECT_EQ(bench.levels() & gpio_bit(pico_bare.flood), 0U);
  EXPECT_NE(bench.levels() & gpio_bit(pico_bare.mist), 0U);
  bench.ask();
  bench.run(pico_clock_rate / 500);
  ASSERT_TRUE(bench.status().has_value());
  EXPECT_NE(bench.status()->inputs & outputs_timed_out, 0);
}

TEST_F(PicoInputs, what_is_no_frame_moves_nothing) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, motors);
  std::vector<std::uint8_t> garbage(3'000);
  for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xA5 : random());
  bench.forget_changes();
  bench.send(garbage);
  bench.run(garbage.size() * 1'280 + 100'000);
  EXPECT_TRUE(bench.changes().empty());
  EXPECT_EQ(bench.pico().lost_bytes(), 0U);
  const StreamKind kind{.shortest_interval = 60, .longest_interval = 90, .shortest_segment = 100, .segments = 5};
  EdgeCheck check = bench.play(random_stream(random, motors, kind));
  EXPECT_TRUE(check.exact());
  EXPECT_EQ(check.error, 0);
}

}  // namespace
}  // namespace passo
