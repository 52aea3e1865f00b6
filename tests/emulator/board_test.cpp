// The real firmware on the emulated chip: every edge of its step pins is the host's, while it is fed over its line.
#include <algorithm>
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// What the chip itself cannot help: an instruction of up to four cycles, on the Mega five, is finished before an
// interrupt begins.
constexpr std::int64_t unavoidable = 3;
constexpr std::int64_t unavoidable_on_mega = 4;

// The UART holds two bytes, and a third one is there 640 cycles after the first: no stretch of work may be as long,
// whether a byte comes in it or not.
constexpr std::uint64_t most_unwatched = 600;

void expect_every_edge(const EdgeCheck& check, std::int64_t most_error, std::int64_t most_apart = unavoidable) {
  EXPECT_TRUE(check.finished);
  EXPECT_EQ(check.steps, check.expected);
  EXPECT_EQ(check.wrong_count, 0U);
  EXPECT_EQ(check.wrong_direction, 0U);
  EXPECT_LE(check.error, most_error);
  EXPECT_LE(check.apart, most_apart);
  EXPECT_EQ(check.overruns, 0U);
  EXPECT_LE(check.unwatched, most_unwatched);
  EXPECT_EQ(check.complaints, 0U);
  // A4988: pulses of 1 microsecond, 200 ns of set-up. DRV8825: 1.9 microseconds, 650 ns.
  EXPECT_GE(check.shortest_pulse, 16U);
  EXPECT_GE(check.shortest_setup, 11U);
  std::printf("%llu edges of %llu events, error %lld cycles, %lld apart, pulse %llu, set-up %llu, unwatched %llu\n",
              static_cast<unsigned long long>(check.steps), static_cast<unsigned long long>(check.events),
              static_cast<long long>(check.error), static_cast<long long>(check.apart),
              static_cast<unsigned long long>(check.shortest_pulse),
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

TEST(Uno, turns_three_motors_at_150_kHz_while_it_is_fed) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  StreamKind kind{
      .shortest_interval = 107, .longest_interval = 120, .shortest_segment = 120, .segments = 120, .ramp = 20};
  expect_every_edge(bench.play(random_stream(random, 3, kind)), unavoidable);
  kind.all_at_every_event = true;
  expect_every_edge(bench.play(random_stream(random, 3, kind)), unavoidable);
}

TEST(Uno, plays_roots_and_bends_in_parts_as_the_host_says) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  expect_every_edge(bench.play(random_stream(
                        random, 3, {.shortest_interval = 408, .longest_interval = 418, .segments = 12, .part = 4})),
                    unavoidable);
  expect_every_edge(bench.play(random_stream(
                        random, 3, {.shortest_interval = 241, .longest_interval = 250, .segments = 12, .part = 5})),
                    unavoidable);
  expect_every_edge(
      bench.play(random_stream(
          random, 3, {.shortest_interval = 117, .longest_interval = 125, .segments = 20, .part = 7, .ramp = 6})),
      unavoidable);
}

// At its deepest: told of its pins, amid motion, asked for all it knows, and stopped by a switch.
// As a motion begins behind a tail: while one item is counted and the next one loaded, the others must last.
TEST(Uno, plays_items_of_one_event_between_slow_ones) {
  const auto item = [](std::uint16_t events, double interval, double change) {
    return BoardSegment{.events = events,
                        .flips = 7,
                        .interval = static_cast<std::uint32_t>(interval * 65536),
                        .change = static_cast<std::int32_t>(change * 65536)};
  };
  std::vector<BoardSegment> items;
  for (int i = 0; i < 6; ++i) {
    items.insert(items.end(), {item(10, 3943, 49), item(10, 4041, 53), item(5, 4023, 120), item(1, 2445, 0),
                               item(1, 2147, 0), item(1, 314, 0), item(1, 4483, 0), item(2, 4355, -113)});
  }
  expect_every_edge(BoardBench(uno_under_test(PASSO_MOTION_UNO)).play(items), unavoidable);
}

TEST(Uno, tells_its_status_amid_motion_without_standing_still) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  int items = 0;
  bench.before_item = [&](std::span<const std::uint8_t>) {
    if (++items % 5 == 0) bench.ask();
  };
  for (const std::uint32_t interval : {150U, 500U, 700U, 3'000U}) {
    const StreamKind kind{.shortest_interval = interval,
                          .longest_interval = interval * 5 / 4,
                          .shortest_segment = static_cast<std::uint8_t>(12'000 / interval),
                          .longest_segment = 100,
                          .segments = 30};
    expect_every_edge(bench.play(random_stream(random, 3, kind)), unavoidable);
  }
}

TEST(Uno, leaves_room_on_its_stack) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  for (const PinSetup& setup : {PinSetup{.inputs = 7, .steps = 7, .outputs = 0x1f, .drivers_rest = 20}, PinSetup{}}) {
    bench.set_up(setup);
    bench.run(200'000);
  }
  static_cast<void>(bench.play(random_stream(random, 3, {.shortest_interval = 107, .longest_interval = 300})));
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

// By itself: 4,096 events of 39,062.5 ticks from step to step.
void expect_one_step_in_ten_seconds(const BoardUnderTest& board, std::int64_t most_error) {
  BoardBench bench(board);
  const BoardSegment slow{.events = 128, .interval = 0x9896'8000, .increments = {16}};
  const EdgeCheck check = bench.play(std::vector<BoardSegment>(64, slow));
  EXPECT_TRUE(check.exact());
  EXPECT_EQ(check.overruns, 0U);
  const SeenSteps steps = bench.seen()[0];
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_NEAR(static_cast<double>(steps[1].time - steps[0].time), 160e6, static_cast<double>(most_error));
}
TEST(Uno, makes_one_step_in_ten_seconds) {
  expect_one_step_in_ten_seconds(uno_under_test(PASSO_MOTION_UNO), unavoidable);
}
TEST(Mega, makes_one_step_in_ten_seconds) {
  expect_one_step_in_ten_seconds(mega_under_test(PASSO_MOTION_MEGA, 4), unavoidable_on_mega);
}

// 10 events a segment at its highest rate: more segments than the line has room for.
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
  EXPECT_TRUE(slipped_after({.shortest_interval = 107,
                             .longest_interval = 112,
                             .shortest_segment = 10,
                             .longest_segment = 10,
                             .segments = 60}));
  EXPECT_FALSE(slipped_after(slow)) << "a hello begins anew";
}

// Also where its ring runs dry at the end of a segment, of which the next one is there.
TEST(Mega, tells_it_where_its_events_come_too_late) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(mega_under_test(PASSO_MOTION_MEGA, 4));
  const auto slipped_after = [&](const StreamKind& kind) {
    const EdgeCheck check = bench.play(random_stream(random, 4, kind));
    EXPECT_TRUE(check.finished);
    EXPECT_EQ(check.wrong_count, 0U);
    EXPECT_EQ(check.wrong_direction, 0U);
    EXPECT_LE(check.unwatched, most_unwatched);
    bench.ask();
    bench.run(100'000);
    return bench.status() && (bench.status()->state & board_slipped) != 0;
  };
  for (const std::uint8_t events : {std::uint8_t{1}, std::uint8_t{3}, std::uint8_t{10}}) {
    EXPECT_TRUE(slipped_after({.shortest_interval = 150,
                               .longest_interval = 160,
                               .shortest_segment = events,
                               .longest_segment = events,
                               .segments = 100}))
        << int{events};
    EXPECT_EQ(bench.status()->state & board_trusted, 0);
  }
  EXPECT_FALSE(slipped_after({.shortest_interval = 1000, .longest_interval = 2000, .segments = 20}));
  EXPECT_NE(bench.status()->state & board_trusted, 0) << "a hello begins anew";
}

// As a host says: pulses, and the times before and behind a direction's change.
void expect_timing(BoardBench& bench, std::mt19937_64& random, std::uint8_t motors, std::int64_t most_error) {
  for (const StepTiming& wanted :
       {StepTiming{}, StepTiming{.pulse = 31, .set_up = 11, .hold = 11}, StepTiming{.pulse = 40, .set_up = 80},
        StepTiming{.pulse = 80, .set_up = 80, .hold = 80}, StepTiming{.pulse = 160, .hold = 255}}) {
    bench.set_up({.timing = wanted});
    bench.run(50'000);
    ASSERT_TRUE(bench.pin_setup());
    const StepTiming has = bench.pin_setup()->timing;
    std::printf("pulse %u, set-up %u, hold %u: %u ticks an event\n", has.pulse, has.set_up, has.hold, has.event_ticks);
    StreamKind kind{.shortest_interval = has.event_ticks,
                    .longest_interval = has.event_ticks * 9U / 8U,
                    .shortest_segment = 150,
                    .segments = 40,
                    .ramp = 20};
    const EdgeCheck check = bench.play(random_stream(random, motors, kind));
    EXPECT_TRUE(check.exact());
    EXPECT_LE(check.error, most_error);
    EXPECT_EQ(check.overruns, 0U);
    EXPECT_LT(check.unwatched, 640U) << "the interrupt may be in a long pulse";
    EXPECT_GE(has.pulse, wanted.pulse);
    EXPECT_GE(check.shortest_pulse, has.pulse);
    EXPECT_GE(has.set_up, wanted.set_up);
    EXPECT_GE(check.shortest_setup, has.set_up);
    EXPECT_GE(check.shortest_hold, std::min(has.hold, std::uint8_t{200}));
    if (wanted.hold < 200) {
      EXPECT_GE(has.hold, wanted.hold);
    }
    // Slower, with waits between the events on the Uno.
    for (const std::uint32_t slowly : {257U, 520U, 3000U}) {
      const std::uint32_t interval = std::max<std::uint32_t>(slowly, has.event_ticks);
      bench.set_up({.timing = wanted});
      const EdgeCheck slower =
          bench.play(random_stream(random, motors,
                                   {.shortest_interval = interval,
                                    .longest_interval = interval * 5U / 4U,
                                    .shortest_segment = static_cast<std::uint8_t>(interval < 1000 ? 60 : 5),
                                    .segments = 20}));
      EXPECT_TRUE(slower.exact()) << interval;
      EXPECT_LE(slower.error, most_error) << interval;
      EXPECT_GE(slower.shortest_pulse, has.pulse);
    }
    // A segment that is two ticks too fast is refused.
    bench.set_up({.timing = wanted});
    bench.start({{.events = 200, .flips = 7, .interval = (has.event_ticks - 2U) << 16}});
    bench.run(200'000);
    ASSERT_TRUE(bench.error().has_value());
    EXPECT_EQ(bench.error()->reason, WireError::bad_value);
  }
}
TEST(Uno, makes_pulses_and_set_up_times_as_its_host_needs_them) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  expect_timing(bench, random, 3, unavoidable);
}
TEST(Mega, makes_pulses_and_set_up_times_as_its_host_needs_them) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(mega_under_test(PASSO_MOTION_MEGA, 4));
  expect_timing(bench, random, 4, unavoidable_on_mega);
}

// As many items as there are events, at every rate, also where the line cannot bring as many and the ring runs dry.
// Then nobody but the main loop reads the line, which holds two bytes.
void expect_no_byte_lost(const BoardUnderTest& board) {
  std::mt19937_64 random(test::seed());
  for (const std::uint8_t longest : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{4}}) {
    for (const std::uint32_t interval : {150U, 250U, 400U, 700U, 1200U, 2500U, 6000U, 15'000U}) {
      for (const std::uint32_t spread : {1U, 4U}) {
        SCOPED_TRACE(testing::Message() << "up to " << int{longest} << " events each " << interval << " ticks, times "
                                        << spread);
        BoardBench bench(board);
        int items = 0;
        bench.before_item = [&](std::span<const std::uint8_t>) {
          if (++items % 7 == 0) bench.ask();
        };
        const EdgeCheck check = bench.play(random_stream(random, static_cast<std::uint8_t>(board.motors.size()),
                                                         {.shortest_interval = interval,
                                                          .longest_interval = interval * spread,
                                                          .shortest_segment = 1,
                                                          .longest_segment = longest,
                                                          .segments = 80}));
        EXPECT_EQ(check.overruns, 0U);
        EXPECT_LE(check.unwatched, most_unwatched);
        EXPECT_TRUE(check.exact());
        EXPECT_EQ(check.complaints, 0U);
      }
    }
  }
}
TEST(Uno, loses_no_byte_where_items_have_few_events) {
  expect_no_byte_lost(uno_under_test(PASSO_MOTION_UNO));
}
TEST(Mega, loses_no_byte_where_items_have_few_events) {
  expect_no_byte_lost(mega_under_test(PASSO_MOTION_MEGA, 4));
}

// It states 106 ticks an event (150,943 a second), and rounding may cost a segment one of them.
TEST(Uno, refuses_a_segment_faster_than_it_states) {
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  bench.start({{.events = 200, .flips = 7, .interval = 104 << 16}});
  bench.run(200'000);
  ASSERT_TRUE(bench.error().has_value());
  EXPECT_EQ(bench.error()->reason, WireError::bad_value);
  EXPECT_TRUE(bench.ports().changes().empty());
}

void expect_nothing_of_garbage(BoardBench& bench, std::mt19937_64& random) {
  std::vector<std::uint8_t> garbage(2'000);
  for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xA5 : random());
  bench.ports().forget_changes();
  bench.uart().send(garbage);
  bench.run(garbage.size() * 320 + 100'000);
  EXPECT_TRUE(bench.ports().changes().empty()) << "nothing of that was a segment";
}

TEST(Uno, steps_right_after_any_garbage_on_its_line) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
  for (int trial = 0; trial < 5; ++trial) {
    expect_nothing_of_garbage(bench, random);
    StreamKind kind{.shortest_interval = 200, .longest_interval = 300, .shortest_segment = 60, .segments = 20};
    expect_every_edge(bench.play(random_stream(random, 3, kind)), unavoidable);
  }
}

// Four ports are written one after the other: three cycles from the first to the last, and what the interrupt's own
// delay adds where a motor made no edge at the least of it.
constexpr std::int64_t apart_on_mega = 3 + unavoidable_on_mega;

TEST(Mega, steps_as_the_host_says_at_every_rate_with_any_number_of_motors) {
  std::mt19937_64 random(test::seed());
  for (std::uint8_t motors = 1; motors <= 6; ++motors) {
    BoardBench bench(mega_under_test(PASSO_MOTION_MEGA, motors));
    for (const std::uint32_t interval : {60'000U, 5'000U, 1'000U, 300U}) {
      const std::uint32_t fastest = motors > 4 ? 200 : 150;
      const StreamKind kind{.shortest_interval = std::max(interval / 2, fastest),
                            .longest_interval = interval,
                            .shortest_segment = interval < 1000 ? std::uint8_t{100} : std::uint8_t{1},
                            .longest_segment = 140,
                            .segments = 20,
                            .ramp = interval < 1000 ? 5 : 0};
      expect_every_edge(bench.play(random_stream(random, motors, kind)), unavoidable_on_mega, apart_on_mega);
    }
  }
}

TEST(Mega, turns_four_motors_at_110_kHz_while_it_is_fed) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(mega_under_test(PASSO_MOTION_MEGA, 4));
  StreamKind kind{
      .shortest_interval = 145, .longest_interval = 163, .shortest_segment = 120, .segments = 120, .ramp = 20};
  expect_every_edge(bench.play(random_stream(random, 4, kind)), unavoidable_on_mega, apart_on_mega);
  kind.all_at_every_event = true;
  expect_every_edge(bench.play(random_stream(random, 4, kind)), unavoidable_on_mega, apart_on_mega);
}

TEST(Mega, turns_six_motors_at_90_kHz_while_it_is_fed) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(mega_under_test(PASSO_MOTION_MEGA, 6));
  const StreamKind kind{
      .shortest_interval = 178, .longest_interval = 200, .shortest_segment = 120, .segments = 120, .ramp = 20};
  expect_every_edge(bench.play(random_stream(random, 6, kind)), unavoidable_on_mega, apart_on_mega);
}

// A motor that an earlier host drove stands still under one that does not know it.
TEST(Mega, leaves_motors_alone_that_the_host_does_not_know) {
  std::mt19937_64 random(test::seed());
  const BoardUnderTest board = mega_under_test(PASSO_MOTION_MEGA, 6);
  BoardBench bench(board);
  const StreamKind kind{.shortest_interval = 400, .longest_interval = 500, .shortest_segment = 100, .segments = 10};
  expect_every_edge(bench.play(random_stream(random, 6, kind)), unavoidable_on_mega, apart_on_mega);
  bench.drive_motors(2);
  expect_every_edge(bench.play(random_stream(random, 2, kind)), unavoidable_on_mega, apart_on_mega);
  for (std::uint8_t m = 2; m < board.motors.size(); ++m) {
    const Pin step = board.motors[m].step;
    const auto moves = [&step](const PortChange& change) {
      return change.port == step.port && ((change.before ^ change.now) & step.mask()) != 0;
    };
    EXPECT_EQ(std::ranges::count_if(bench.ports().changes(), moves), 0) << "motor " << int{m};
  }
}

TEST(Mega, steps_right_after_any_garbage_on_its_line) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(mega_under_test(PASSO_MOTION_MEGA, 4));
  expect_nothing_of_garbage(bench, random);
  const StreamKind kind{.shortest_interval = 200, .longest_interval = 300, .shortest_segment = 100, .segments = 20};
  expect_every_edge(bench.play(random_stream(random, 4, kind)), unavoidable_on_mega, apart_on_mega);
}

}  // namespace
}  // namespace passo
