// The emulated board's limit switches where one of them is watched: that one captures, to the very event, and all
// others stop the motors as ever.
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "emulator/streamed_run.hpp"
#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/mega_windings.hpp"
#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/chip/uno_windings.hpp"

namespace passo {
namespace {

// A board, the fastest that it plays, and how long before an edge its interrupt has looked at the pins.
struct HomingBoard {
  BoardUnderTest board;
  std::uint32_t interval;
  std::uint64_t look;  // in C++, longer
  std::vector<Pin> limits = {};
};

template <class Map>
HomingBoard with_limits(HomingBoard kind, const Map& pins) {
  for (const Pin pin : pins.limits) {
    if (pin.exists()) kind.limits.push_back(pin);
  }
  return kind;
}

HomingBoard uno() {
  return with_limits({.board = uno_under_test(PASSO_MOTION_UNO), .interval = 107, .look = 4}, uno_cnc_shield);
}
HomingBoard mega() {
  return with_limits({.board = mega_under_test(PASSO_MOTION_MEGA, 4), .interval = 145, .look = 18}, mega_ramps);
}
HomingBoard uno_windings_board() {
  return with_limits({.board = uno_windings_under_test(PASSO_MOTION_UNO_TWO_ON,
                                                       {DriveMode::two_on, DriveMode::two_on, DriveMode::two_on}),
                      .interval = 457,
                      .look = 260},
                     uno_windings);
}
HomingBoard mega_windings_board() {
  return with_limits(
      {.board = mega_windings_under_test(PASSO_MOTION_MEGA_TWO_ON,
                                         {DriveMode::two_on, DriveMode::two_on, DriveMode::two_on, DriveMode::two_on}),
       .interval = 533,
       .look = 260},
      mega_windings);
}

std::uint8_t bit_of(std::size_t limit) {
  return static_cast<std::uint8_t>(1U << limit);
}

std::vector<BoardSegment> long_run(std::uint32_t interval, int segments) {
  BoardSegment segment{.events = 200, .flips = 7, .interval = interval << 16};
  return std::vector<BoardSegment>(static_cast<std::size_t>(segments), segment);
}

void set(BoardBench& bench, Pin pin, bool closed) {
  bench.ports().set_input(pin.port, pin.bit, !closed);
}

constexpr std::uint64_t the_end = ~0ULL >> 1U;

// Of those that a motor has begun, up to a cycle.
std::int32_t steps_until(const SeenSteps& seen, std::uint64_t cycle) {
  return static_cast<std::int32_t>(
      std::ranges::count_if(seen, [&](const SeenStep& step) { return step.time <= static_cast<std::int64_t>(cycle); }));
}

// Closes it, or opens it, at each few cycles from one event to the next.
void expect_exact_capture(const HomingBoard& kind, std::size_t limit, bool closes, std::uint32_t every) {
  SCOPED_TRACE("limit pin " + std::to_string(limit) + (closes ? " closes" : " opens"));
  for (std::uint32_t phase = 0; phase < kind.interval; phase += every) {
    BoardBench bench(kind.board);
    set(bench, kind.limits[limit], !closes);
    bench.run(300'000);
    bench.start(long_run(kind.interval, 7), bit_of(limit));
    ASSERT_TRUE(bench.status().has_value());
    EXPECT_EQ(bench.status()->state & ~board_encodes, board_trusted | board_homes);
    bench.run(120'000 + phase * (kind.interval + 1));
    const std::uint64_t switched = bench.cycles();
    set(bench, kind.limits[limit], closes);
    bench.run(700'000);
    ASSERT_FALSE(bench.fault().has_value());
    ASSERT_TRUE(bench.captured().has_value());
    EXPECT_EQ(bench.captured()->input, closes ? unsigned{bit_of(limit)} : bit_of(limit) | captured_released);
    const std::int32_t position = bench.captured()->positions[0];
    const SeenSteps seen = bench.seen()[0];
    EXPECT_GE(position, steps_until(seen, switched)) << "phase " << phase;
    EXPECT_LE(position, steps_until(seen, switched + kind.look)) << "phase " << phase;
    EXPECT_GT(position, 10);
    EXPECT_EQ(steps_until(seen, the_end), 1400) << "it goes on to the end";
  }
}

void expect_stop(const HomingBoard& kind, Pin pin, std::uint8_t watched, FaultReason reason, std::uint64_t edge) {
  BoardBench bench(kind.board);
  bench.start(long_run(kind.interval, 7), watched);
  bench.run(120'000);
  const std::uint64_t switched = bench.cycles();
  set(bench, pin, true);
  bench.run(700'000);
  ASSERT_TRUE(bench.fault().has_value());
  EXPECT_EQ(bench.fault()->reason, reason);
  const SeenSteps seen = bench.seen()[0];
  EXPECT_EQ(steps_until(seen, the_end), steps_until(seen, switched + edge));
  EXPECT_LT(steps_until(seen, the_end), 1400);
}

void expect_all_others_to_stop(const HomingBoard& kind, Pin emergency_stop, std::uint64_t edge) {
  for (std::size_t watched = 0; watched < 3; ++watched) {
    for (std::size_t limit = 0; limit < kind.limits.size(); ++limit) {
      if (limit == watched) continue;
      SCOPED_TRACE("limit pin " + std::to_string(limit) + " while " + std::to_string(watched) + " is watched");
      expect_stop(kind, kind.limits[limit], bit_of(watched), FaultReason::limit, edge);
    }
    expect_stop(kind, emergency_stop, bit_of(watched), FaultReason::emergency_stop, edge);
  }
}

// Another axis stands on its switch: that stops nothing, and neither does the change of a pin on the same port.
void expect_closed_others_not_to_stop(const HomingBoard& kind) {
  BoardBench bench(kind.board);
  for (std::size_t limit = 1; limit < kind.limits.size(); ++limit) {
    set(bench, kind.limits[limit], true);
  }
  bench.run(300'000);
  bench.start(long_run(kind.interval, 7), 1);
  bench.run(120'000);
  set(bench, kind.limits[0], true);
  bench.run(100'000);
  set(bench, kind.limits[0], false);
  bench.run(700'000);
  EXPECT_FALSE(bench.fault().has_value());
  EXPECT_EQ(steps_until(bench.seen()[0], the_end), 1400);
  // The next host has all of them again, and what is closed already is for it to look at.
  set(bench, kind.limits[1], false);
  set(bench, kind.limits[2], false);
  for (std::size_t limit = 3; limit < kind.limits.size(); ++limit) set(bench, kind.limits[limit], false);
  bench.run(300'000);
  bench.start(long_run(kind.interval, 7));
  bench.run(120'000);
  set(bench, kind.limits[0], true);
  bench.run(700'000);
  EXPECT_TRUE(bench.fault().has_value()) << "a hello ends the watch";
}

// Two switches are watched as one, which is on while any of them is. What is told names those that changed.
void expect_right_names(const HomingBoard& kind, std::size_t one, std::size_t other) {
  SCOPED_TRACE("limit pins " + std::to_string(one) + " and " + std::to_string(other));
  BoardBench bench(kind.board);
  bench.run(300'000);
  bench.start(long_run(8 * kind.interval, 7), bit_of(one) | bit_of(other));
  bench.run(120'000);
  // Opens and closes both, and tells which are on and what was captured.
  const auto press = [&](unsigned on, std::optional<unsigned> captured) {
    SCOPED_TRACE("on: " + std::to_string(on));
    const std::int32_t before = bench.captured() ? bench.captured()->positions[0] : 0;
    const std::uint64_t pressed = bench.cycles();
    set(bench, kind.limits[one], (on & bit_of(one)) != 0);
    set(bench, kind.limits[other], (on & bit_of(other)) != 0);
    bench.run(80'000);
    ASSERT_TRUE(bench.captured().has_value());
    const std::int32_t after = bench.captured()->positions[0];
    if (captured) {
      EXPECT_EQ(bench.captured()->input, *captured);
      EXPECT_GE(after, steps_until(bench.seen()[0], pressed));
      EXPECT_LE(after, steps_until(bench.seen()[0], pressed + kind.look));
    } else {
      EXPECT_EQ(after, before) << "whether any is on has not changed";
    }
    bench.ask();
    bench.run(40'000);
    ASSERT_TRUE(bench.status().has_value());
    EXPECT_EQ(bench.status()->inputs & 0xffU, on);
    EXPECT_NE(bench.status()->state & board_moves, 0) << "amid the motion";
  };
  const unsigned first = bit_of(one);
  const unsigned second = bit_of(other);
  press(second, second);
  press(first | second, std::nullopt);
  press(first, std::nullopt);
  press(0, first | captured_released);
  press(first | second, first | second);
  press(second, std::nullopt);
  press(0, second | captured_released);
  press(first, first);
  EXPECT_FALSE(bench.fault().has_value());
}

// With drivers the pins are looked at in assembly, of each port by itself; with windings in C++.
TEST(UnoHoming, a_watched_limit_switch_captures_the_very_event) {
  const HomingBoard kind = uno();
  for (std::size_t limit = 0; limit < kind.limits.size(); ++limit) {
    expect_exact_capture(kind, limit, true, limit == 0 ? 1 : 3);
    expect_exact_capture(kind, limit, false, 13);
  }
}
TEST(MegaHoming, a_watched_limit_switch_captures_the_very_event) {
  const HomingBoard kind = mega();
  for (std::size_t limit = 0; limit < kind.limits.size(); ++limit) {
    expect_exact_capture(kind, limit, true, limit == 0 ? 1 : 3);
    expect_exact_capture(kind, limit, false, 13);
  }
}
TEST(WindingsHoming, a_watched_limit_switch_captures_the_very_event) {
  for (const HomingBoard& kind : {uno_windings_board(), mega_windings_board()}) {
    for (std::size_t limit = 0; limit < kind.limits.size(); limit += 2) {
      expect_exact_capture(kind, limit, true, 61);
      expect_exact_capture(kind, limit, false, 97);
    }
  }
}

// The two of an axis with two motors are on one port.
TEST(UnoHoming, of_several_watched_switches_those_that_changed_are_named) {
  expect_right_names(uno(), 0, 1);
  expect_right_names(uno(), 2, 0);
  expect_right_names(uno_windings_board(), 1, 2);
}
TEST(MegaHoming, of_several_watched_switches_those_that_changed_are_named) {
  for (std::size_t axis = 0; axis < 3; ++axis) expect_right_names(mega(), axis, axis + 3);
  expect_right_names(mega_windings_board(), 0, 3);
}

TEST(UnoHoming, all_other_limit_switches_stop_it) {
  expect_all_others_to_stop(uno(), uno_cnc_shield.emergency_stop, 4);
}
TEST(MegaHoming, all_other_limit_switches_stop_it) {
  expect_all_others_to_stop(mega(), mega_ramps.emergency_stop, 20);
}

TEST(UnoHoming, other_axes_may_stand_on_their_switches) {
  expect_closed_others_not_to_stop(uno());
  expect_closed_others_not_to_stop(uno_windings_board());
}
TEST(MegaHoming, other_axes_may_stand_on_their_switches) {
  expect_closed_others_not_to_stop(mega());
  expect_closed_others_not_to_stop(mega_windings_board());
}

}  // namespace
}  // namespace passo
