// The Mega's encoder: no pulse is lost however fast they come, while four motors step at the board's highest rate and
// the host asks again and again; and no edge is later for it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_encoder.hpp"

namespace passo {
namespace {

constexpr double clock_rate = 16e6;
constexpr std::int64_t error_on_mega = 4;

struct Counted {
  int answers = 0;
  std::int64_t least = INT64_MAX;  // counts by which an answer was beyond what the encoder had given at its tick
  std::int64_t most = INT64_MIN;
  double worst_index = 0;  // counts
};

// At `rate` pulses a second, of 1,000 a turn.
Counted count_at(double rate, std::uint8_t motors, std::uint32_t interval) {
  constexpr int pulses_per_turn = 1000;
  std::mt19937_64 random(test::seed());
  BoardBench bench(mega_under_test(PASSO_MOTION_MEGA, motors));
  // The program has begun by now: it counts from here on.
  const std::uint64_t start = bench.cycles();
  EmulatedEncoder encoder(bench.chip(), pulses_per_turn, [&](std::uint64_t cycle) {
    return static_cast<double>(cycle - std::min(start, cycle)) / clock_rate * rate / pulses_per_turn;
  });
  Counted counted;
  std::uint32_t last = 0;
  bench.on_turned = [&](const Turned& turned) {
    // The clock's tick is the chip's cycle since the timer was started, which was some cycles behind the reset.
    EXPECT_GE(turned.spindle.count, last);
    last = turned.spindle.count;
    const std::uint64_t told = turned.spindle.tick + bench.timer().started();
    const auto given = static_cast<std::int64_t>(encoder.pulses_at(told));
    counted.least = std::min(counted.least, static_cast<std::int64_t>(turned.spindle.count) - given);
    counted.most = std::max(counted.most, static_cast<std::int64_t>(turned.spindle.count) - given);
    const double index = turned.spindle.at_index;
    counted.worst_index = std::max(counted.worst_index, index - std::floor(index / pulses_per_turn) * pulses_per_turn);
    ++counted.answers;
  };
  int items = 0;
  bench.before_item = [&](std::span<const std::uint8_t>) {
    if (++items % 4 == 0) bench.ask({.question = Question::spindle});
  };
  const StreamKind kind{.shortest_interval = interval,
                        .longest_interval = interval + interval / 8,
                        .shortest_segment = 200,
                        .segments = 150,
                        .ramp = 12};
  const EdgeCheck check = bench.play(random_stream(random, motors, kind));
  EXPECT_TRUE(check.exact());
  EXPECT_EQ(check.overruns, 0U);
  EXPECT_EQ(check.complaints, 0U);
  EXPECT_LE(check.error, error_on_mega);
  EXPECT_LT(check.unwatched, 640U) << "a byte may be lost";
  return counted;
}

TEST(MegaEncoder, counts_every_pulse_at_110_kHz_of_four_motors) {
  for (const double rate : {100.0, 10'000.0, 100'000.0, 1'000'000.0, 4'000'000.0}) {
    const Counted counted = count_at(rate, 4, 146);
    std::printf("%.0f pulses a second: %d answers, %lld to %lld counts beyond the tick's, index late by %.0f at most\n",
                rate, counted.answers, static_cast<long long>(counted.least), static_cast<long long>(counted.most),
                counted.worst_index);
    EXPECT_GT(counted.answers, 20);
    // Read behind the tick, by less than 10 microseconds.
    EXPECT_GE(counted.least, 0);
    EXPECT_LE(static_cast<double>(counted.most), 1 + rate * 10e-6);
    // That is seen in the main loop, within 2 ms at this load; which of the last thousand counts it was, only where
    // they take longer.
    if (rate * 2e-3 < 1000) {
      EXPECT_LE(counted.worst_index, 1 + rate * 2e-3);
    }
  }
}

// Where events come seldom only the main loop looks at the line.
TEST(MegaEncoder, loses_no_byte_of_its_line_where_it_steps_slowly) {
  EXPECT_GT(count_at(10'240, 3, 2000).answers, 20);
}

}  // namespace
}  // namespace passo
