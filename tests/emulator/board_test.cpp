// The real firmware on the emulated chip: every edge of its step pins is the host's, while it is fed over its line.
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// What the chip itself cannot help: an instruction of up to four cycles is finished before an interrupt begins.
constexpr std::int64_t unavoidable = 3;

// The UART holds two bytes, and a third one is there 640 cycles after the first: no stretch of work may be as long,
// whether a byte comes in it or not.
constexpr std::uint64_t most_unwatched = 600;

void expect_every_edge(const EdgeCheck& check, std::int64_t most_error) {
  EXPECT_TRUE(check.finished);
  EXPECT_EQ(check.steps, check.expected);
  EXPECT_EQ(check.wrong_count, 0U);
  EXPECT_EQ(check.wrong_direction, 0U);
  EXPECT_LE(check.spread(), most_error);
  EXPECT_EQ(check.overruns, 0U);
  EXPECT_LE(check.unwatched, most_unwatched);
  EXPECT_EQ(check.complaints, 0U);
  // A4988: pulses of 1 microsecond, 200 ns of set-up. DRV8825: 1.9 microseconds, 650 ns.
  EXPECT_GE(check.shortest_pulse, 16U);
  EXPECT_GE(check.shortest_setup, 11U);
  std::printf("%llu edges of %llu events, error %lld cycles, pulse %llu, set-up %llu, unwatched %llu\n",
              static_cast<unsigned long long>(check.steps), static_cast<unsigned long long>(check.events),
              static_cast<long long>(check.spread()), static_cast<unsigned long long>(check.shortest_pulse),
              static_cast<unsigned long long>(check.shortest_setup), static_cast<unsigned long long>(check.unwatched));
}

TEST(Uno, steps_as_the_host_says_at_every_rate) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  for (const std::uint32_t interval : {60'000U, 5'000U, 1'000U, 300U}) {
    const EdgeCheck check =
        bench.play(random_stream(random, 3,
                                 {.shortest_interval = interval / 2,
                                  .longest_interval = interval,
                                  .shortest_segment = interval < 1000 ? std::uint8_t{60} : std::uint8_t{1},
                                  .longest_segment = 120,
                                  .segments = 30}));
    expect_every_edge(check, unavoidable);
  }
}

TEST(Uno, turns_three_motors_at_140_kHz_while_it_is_fed) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  StreamKind kind{
      .shortest_interval = 114, .longest_interval = 128, .shortest_segment = 120, .segments = 120, .ramp = 20};
  expect_every_edge(bench.play(random_stream(random, 3, kind)), unavoidable);
  kind.all_at_every_event = true;
  expect_every_edge(bench.play(random_stream(random, 3, kind)), unavoidable);
}

// At its deepest: amid motion, asked for all it knows, and stopped by a switch.
TEST(Uno, leaves_room_on_its_stack) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  static_cast<void>(bench.play(random_stream(random, 3, {.shortest_interval = 114, .longest_interval = 300})));
  bench.start(random_stream(random, 3, {.shortest_interval = 200, .longest_interval = 900, .segments = 10}));
  for (int i = 0; i < 40; ++i) {
    bench.ask();
    bench.run(20'000);
  }
  bench.ports().set_input('C', 0, false);
  bench.run(200'000);
  EXPECT_TRUE(bench.fault().has_value());
  const std::size_t left = bench.chip().longest_untouched();
  std::printf("%zu bytes that were never written\n", left);
  EXPECT_GE(left, 24U);
}

// One step in ten seconds: no interval is that long, so events without a step come between.
TEST(Uno, is_as_exact_when_it_is_slow) {
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  const BoardSegment slow{.events = 255, .interval = 0xffff'ffff, .increments = {27, 65535, 0}};
  expect_every_edge(bench.play({slow, slow, slow, slow, slow}), unavoidable);
}

// 30 events a segment at its highest rate: more segments than the line has room for.
TEST(Uno, loses_no_step_and_tells_it_where_its_events_come_too_late) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  const auto slipped_after = [&](const StreamKind& kind) {
    const EdgeCheck check = bench.play(random_stream(random, 3, kind));
    EXPECT_TRUE(check.finished);
    EXPECT_EQ(check.wrong_count, 0U);
    EXPECT_EQ(check.wrong_direction, 0U);
    EXPECT_EQ(check.overruns, 0U);
    EXPECT_LE(check.unwatched, most_unwatched);
    bench.ask();
    bench.run(100'000);
    return bench.status() && (bench.status()->state & board_slipped) != 0;
  };
  const StreamKind slow{.shortest_interval = 400, .longest_interval = 500, .shortest_segment = 60, .segments = 20};
  EXPECT_TRUE(slipped_after({.shortest_interval = 114,
                             .longest_interval = 120,
                             .shortest_segment = 30,
                             .longest_segment = 30,
                             .segments = 60}));
  EXPECT_FALSE(slipped_after(slow)) << "a hello begins anew";
}

TEST(Uno, refuses_a_segment_faster_than_it_states) {
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  bench.start({{.events = 200, .flips = 7, .interval = 113 << 16}});
  bench.run(200'000);
  ASSERT_TRUE(bench.error().has_value());
  EXPECT_EQ(bench.error()->reason, WireError::bad_value);
  EXPECT_TRUE(bench.ports().changes().empty());
}

TEST(Uno, steps_right_after_any_garbage_on_its_line) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<std::uint8_t> garbage(2'000);
    for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xA5 : random());
    bench.ports().forget_changes();
    bench.uart().send(garbage);
    bench.run(garbage.size() * 320 + 100'000);
    EXPECT_TRUE(bench.ports().changes().empty()) << "nothing of that was a segment";
    StreamKind kind{.shortest_interval = 200, .longest_interval = 300, .shortest_segment = 60, .segments = 20};
    expect_every_edge(bench.play(random_stream(random, 3, kind)), unavoidable);
  }
}

}  // namespace
}  // namespace passo
