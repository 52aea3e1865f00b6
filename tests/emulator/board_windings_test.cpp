// Boards that switch windings themselves, on the emulated chip: each change of each winding is the host's.
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/chip/mega_windings.hpp"
#include "passo/chip/uno_windings.hpp"

namespace passo {
namespace {

struct Image {
  const char* name;
  BoardUnderTest board;
};

std::vector<Image> images() {
  using enum DriveMode;
  const std::vector<DriveMode> mixed = {two_on, wave, half_step, half_step};
  const auto all = [](DriveMode drive) { return std::vector<DriveMode>(4, drive); };
  return {{"uno two_on", uno_windings_under_test(PASSO_MOTION_UNO_TWO_ON, all(two_on))},
          {"uno wave", uno_windings_under_test(PASSO_MOTION_UNO_WAVE, all(wave))},
          {"uno half_step", uno_windings_under_test(PASSO_MOTION_UNO_HALF_STEP, all(half_step))},
          {"uno mixed", uno_windings_under_test(PASSO_MOTION_UNO_MIXED, mixed)},
          {"mega two_on", mega_windings_under_test(PASSO_MOTION_MEGA_TWO_ON, all(two_on))},
          {"mega wave", mega_windings_under_test(PASSO_MOTION_MEGA_WAVE, all(wave))},
          {"mega half_step", mega_windings_under_test(PASSO_MOTION_MEGA_HALF_STEP, all(half_step))},
          {"mega mixed", mega_windings_under_test(PASSO_MOTION_MEGA_MIXED, mixed)}};
}

void expect_every_change(const EdgeCheck& check, const char* name) {
  EXPECT_TRUE(check.finished) << name;
  EXPECT_EQ(check.steps, check.expected) << name;
  EXPECT_EQ(check.wrong_count, 0U) << name;
  EXPECT_EQ(check.wrong_direction, 0U) << name;
  EXPECT_LE(check.error, 4) << name;
  EXPECT_LE(check.apart_in_motor, 8) << name;
  EXPECT_EQ(check.overruns, 0U) << name;
  EXPECT_LE(check.unwatched, 600U) << name;
  EXPECT_EQ(check.complaints, 0U) << name;
  std::printf("%s: %llu steps of %llu events, error %lld cycles, %lld apart, %lld in one motor, unwatched %llu\n", name,
              static_cast<unsigned long long>(check.steps), static_cast<unsigned long long>(check.events),
              static_cast<long long>(check.error), static_cast<long long>(check.apart),
              static_cast<long long>(check.apart_in_motor), static_cast<unsigned long long>(check.unwatched));
}

TEST(Windings, change_as_the_host_says_at_every_rate) {
  std::mt19937_64 random(test::seed());
  for (const Image& image : images()) {
    const auto motors = static_cast<std::uint8_t>(image.board.motors.size());
    BoardBench bench(image.board);
    for (const std::uint32_t interval : {60'000U, 5'000U, 1'500U}) {
      const StreamKind kind{.shortest_interval = interval / 2,
                            .longest_interval = interval,
                            .shortest_segment = interval < 5'000 ? std::uint8_t{30} : std::uint8_t{1},
                            .longest_segment = 120,
                            .segments = 30};
      expect_every_change(bench.play(random_stream(random, motors, kind)), image.name);
    }
  }
}

TEST(Windings, change_at_their_highest_rate_while_the_board_is_fed) {
  std::mt19937_64 random(test::seed());
  for (const Image& image : images()) {
    const auto motors = static_cast<std::uint8_t>(image.board.motors.size());
    BoardBench bench(image.board);
    const std::uint32_t fastest = motors == 3 ? 458 : 534;  // 35 and 30 kHz
    StreamKind kind{.shortest_interval = fastest,
                    .longest_interval = fastest + 80,
                    .shortest_segment = 100,
                    .segments = 60,
                    .ramp = 20};
    expect_every_change(bench.play(random_stream(random, motors, kind)), image.name);
    kind.all_at_every_event = true;
    expect_every_change(bench.play(random_stream(random, motors, kind)), image.name);
  }
}

// Eight events a segment: more segments than the board has time for.
TEST(Windings, lose_no_step_where_events_come_too_late) {
  std::mt19937_64 random(test::seed());
  for (const Image& image : images()) {
    BoardBench bench(image.board);
    const StreamKind kind{
        .shortest_interval = 540, .longest_interval = 600, .shortest_segment = 4, .longest_segment = 8, .segments = 90};
    const EdgeCheck check =
        bench.play(random_stream(random, static_cast<std::uint8_t>(image.board.motors.size()), kind));
    EXPECT_TRUE(check.exact()) << image.name << ": " << check.steps << " of " << check.expected;
    bench.ask();
    bench.run(100'000);
    ASSERT_TRUE(bench.status().has_value());
    EXPECT_NE(bench.status()->state & board_slipped, 0) << image.name;
  }
}

// The bits of all windings, as the board drives them now.
unsigned windings_with_current(const BoardBench& bench, const BoardUnderTest& board) {
  unsigned count = 0;
  for (const MotorPins& motor : board.motors) {
    for (const Pin pin : motor.windings) count += (bench.ports().outputs(pin.port) & pin.mask()) != 0 ? 1U : 0U;
  }
  return count;
}

std::vector<BoardSegment> run_of(std::uint32_t interval, int segments) {
  return std::vector<BoardSegment>(static_cast<std::size_t>(segments),
                                   BoardSegment{.events = 200, .flips = 7, .interval = interval << 16});
}

struct Stop {
  BoardUnderTest board;
  Pin pin;
  FaultReason reason;
};

// Closes a switch in the middle of a motion: no step begins after it, the windings hold or are off, and the next host's
// motion goes on from the patterns that the motors stand at.
void expect_stop(const Stop& stop) {
  constexpr std::uint32_t interval = 640;
  std::mt19937_64 random(test::seed());
  std::uint64_t last = 0;
  std::uint64_t off = 0;
  for (std::uint32_t phase = 0; phase < interval; phase += 67) {
    BoardBench bench(stop.board);
    EXPECT_EQ(windings_with_current(bench, stop.board), 0U) << "before the first step";
    bench.start(run_of(interval, 5));
    bench.run(150'000 + phase * (interval + 1));
    ASSERT_FALSE(bench.fault().has_value());
    EXPECT_GT(windings_with_current(bench, stop.board), 0U);
    const std::uint64_t switched = bench.cycles();
    const std::size_t changes = bench.ports().changes().size();
    bench.ports().set_input(stop.pin.port, stop.pin.bit, false);
    bench.run(100'000);
    ASSERT_TRUE(bench.fault().has_value());
    EXPECT_EQ(bench.fault()->reason, stop.reason);
    const bool holds = stop.reason == FaultReason::limit;
    EXPECT_EQ(windings_with_current(bench, stop.board) != 0, holds);
    for (std::size_t i = changes; i < bench.ports().changes().size(); ++i) {
      const PortChange& change = bench.ports().changes()[i];
      const bool only_off = (change.now & ~change.before) == 0 && !holds;
      (only_off ? off : last) = std::max(only_off ? off : last, change.cycle - switched);
    }
    bench.ports().set_input(stop.pin.port, stop.pin.bit, true);
    bench.run(200'000);
    const std::vector<BoardSegment> next =
        random_stream(random, 3, {.shortest_interval = 1'000, .longest_interval = 2'000, .segments = 5});
    bench.follow_windings();
    const EdgeCheck check = bench.play(next);
    EXPECT_TRUE(check.exact()) << check.steps << " of " << check.expected;
  }
  std::printf("last step begins %llu cycles after the switch, all off after %llu\n",
              static_cast<unsigned long long>(last), static_cast<unsigned long long>(off));
  EXPECT_LE(last, 60U);
  EXPECT_LE(off, 8'000U) << "half a millisecond";
}

TEST(Windings, are_off_after_an_emergency_stop) {
  const std::vector<DriveMode> drives(4, DriveMode::half_step);
  expect_stop({.board = uno_windings_under_test(PASSO_MOTION_UNO_HALF_STEP, drives),
               .pin = uno_windings.emergency_stop,
               .reason = FaultReason::emergency_stop});
  expect_stop({.board = mega_windings_under_test(PASSO_MOTION_MEGA_HALF_STEP, drives),
               .pin = mega_windings.emergency_stop,
               .reason = FaultReason::emergency_stop});
}
TEST(Windings, hold_at_a_limit_switch) {
  const std::vector<DriveMode> drives(4, DriveMode::two_on);
  expect_stop({.board = uno_windings_under_test(PASSO_MOTION_UNO_TWO_ON, drives),
               .pin = uno_windings.limits[1],
               .reason = FaultReason::limit});
  for (const Pin limit : {mega_windings.limits[0], mega_windings.limits[4]}) {
    expect_stop({.board = mega_windings_under_test(PASSO_MOTION_MEGA_TWO_ON, drives),
                 .pin = limit,
                 .reason = FaultReason::limit});
  }
}

TEST(Windings, leave_room_on_the_stack_of_the_uno) {
  std::mt19937_64 random(test::seed());
  BoardBench bench(
      uno_windings_under_test(PASSO_MOTION_UNO_MIXED, {DriveMode::two_on, DriveMode::wave, DriveMode::half_step}));
  static_cast<void>(bench.play(random_stream(random, 3, {.shortest_interval = 540, .longest_interval = 600})));
  bench.start(random_stream(random, 3, {.shortest_interval = 800, .longest_interval = 900, .segments = 10}));
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

}  // namespace
}  // namespace passo
