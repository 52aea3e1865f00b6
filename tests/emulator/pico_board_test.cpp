// The real firmware on the emulated Pico: every edge of its pins against the host's Player.
#include <algorithm>
#include <random>

#include "emulator/pico_bench.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

class Pico : public ::testing::Test {
 protected:
  void SetUp() override {
    static const std::string why = PicoBench::missing(PASSO_MOTION_PICO);
    if (!why.empty()) GTEST_SKIP() << why;
  }
};

// A driver's data sheet asks for a pulse and a pause of a microsecond, or less.
constexpr std::uint64_t microsecond = 128;

void expect_every_edge(const EdgeCheck& check) {
  EXPECT_TRUE(check.exact()) << check.steps << " of " << check.expected << " steps, " << check.wrong_direction
                             << " in the wrong direction, finished " << check.finished;
  EXPECT_EQ(check.error, 0) << "each edge is at its tick, and all motors' of an event are at the same cycle";
  EXPECT_EQ(check.overruns, 0U);
  EXPECT_EQ(check.complaints, 0U);
  EXPECT_GE(check.shortest_pulse, microsecond);
  EXPECT_LE(check.longest_pulse, 2 * microsecond);
}

TEST_F(Pico, says_what_it_is) {
  PicoBench bench(PASSO_MOTION_PICO, 6);
  bench.start({});
  bench.ask();
  bench.run(pico_clock_rate / 500);
  EXPECT_EQ(bench.capacity(), 250);
  ASSERT_TRUE(bench.status().has_value());
  EXPECT_EQ(bench.status()->motors, 6);
  EXPECT_EQ(bench.status()->reset, ResetCause::power_on);
  EXPECT_EQ(bench.status()->inputs, 0);
}

// The host of src/board/emulator/pico/usb_host.js greets the device as Linux does, and looks at each packet's number.
TEST_F(Pico, speaks_by_usb_as_by_its_uart) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, 3, pico_bare, PicoSocket::usb);
  bench.start({});
  bench.ask();
  bench.run(pico_clock_rate / 500);
  ASSERT_TRUE(bench.status().has_value());
  EXPECT_EQ(bench.status()->motors, 3);
  const StreamKind kind{.shortest_interval = 60, .longest_interval = 90, .shortest_segment = 100, .segments = 300};
  expect_every_edge(bench.play(random_stream(random, 3, kind)));
}

TEST_F(Pico, leaves_the_line_to_who_spoke_first_until_he_is_silent) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, 3, pico_bare, PicoSocket::usb);
  const StreamKind kind{.shortest_interval = 60, .longest_interval = 90, .shortest_segment = 100, .segments = 20};
  expect_every_edge(bench.play(random_stream(random, 3, kind)));
  std::uint8_t question[largest_frame];
  const std::uint8_t size = encode(Ask{.motors = 3}, 0, question);
  const auto is_answered = [&] {
    EXPECT_TRUE(bench.pico().send_by_other_line({question, size}));
    bench.run(pico_clock_rate / 100);
    return bench.status().has_value();
  };
  EXPECT_FALSE(is_answered());
  expect_every_edge(bench.play(random_stream(random, 3, kind)));
  bench.run(2 * pico_clock_rate);
  EXPECT_TRUE(is_answered());
}

// Segments of five events a million times a second: no step is lost, but the board cannot make them in time.
TEST_F(Pico, tells_when_its_events_come_too_late) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO, 3, pico_bare, PicoSocket::usb);
  const auto slipped_after = [&](std::uint8_t events) {
    const EdgeCheck check = bench.play(random_stream(random, 3,
                                                     {.shortest_interval = 16,
                                                      .longest_interval = 16,
                                                      .shortest_segment = events,
                                                      .longest_segment = events,
                                                      .segments = 240,
                                                      .ramp = 12}));
    EXPECT_TRUE(check.finished);
    EXPECT_EQ(check.wrong_count, 0U);
    EXPECT_EQ(check.wrong_direction, 0U);
    bench.ask();
    bench.run(pico_clock_rate / 500);
    return bench.status() && (bench.status()->state & board_slipped) != 0;
  };
  EXPECT_TRUE(slipped_after(5));
  EXPECT_FALSE(slipped_after(200)) << "a hello begins anew";
}

TEST_F(Pico, steps_as_the_host_says_at_every_rate_with_any_number_of_motors) {
  std::mt19937_64 random(test::seed());
  for (const std::uint8_t motors : std::initializer_list<std::uint8_t>{1, 3, 6}) {
    PicoBench bench(PASSO_MOTION_PICO, motors);
    for (const std::uint32_t interval : {30'000U, 1'000U, 100U, 60U}) {
      const StreamKind kind{.shortest_interval = std::max(interval / 2, 32U),
                            .longest_interval = interval,
                            .shortest_segment = interval < 1000 ? std::uint8_t{100} : std::uint8_t{1},
                            .longest_segment = interval > 10'000 ? std::uint8_t{10} : std::uint8_t{140},
                            .segments = 8,
                            .ramp = interval < 1000 ? 2 : 0};
      expect_every_edge(bench.play(random_stream(random, motors, kind)));
    }
  }
}

// More segments than the list holds, so that the line must keep up, too. Eight motors take the pins of the UART.
TEST_F(Pico, turns_eight_motors_at_a_million_events_a_second) {
  std::mt19937_64 random(test::seed());
  PicoBench bench(PASSO_MOTION_PICO_EIGHT, 8, pico_eight, PicoSocket::usb);
  StreamKind kind{
      .shortest_interval = 16, .longest_interval = 20, .shortest_segment = 120, .segments = 400, .ramp = 12};
  const EdgeCheck check = bench.play(random_stream(random, 8, kind));
  EXPECT_TRUE(check.exact()) << check.steps << " of " << check.expected << " steps, finished " << check.finished;
  EXPECT_EQ(check.error, 0);
  EXPECT_EQ(check.complaints, 0U);
  EXPECT_GE(check.shortest_pulse, microsecond / 2 - pico_cycles_of_tick);
  bench.ask();
  bench.run(pico_clock_rate / 500);
  ASSERT_TRUE(bench.status().has_value());
  EXPECT_EQ(bench.status()->state & board_slipped, 0);
}

}  // namespace
}  // namespace passo
