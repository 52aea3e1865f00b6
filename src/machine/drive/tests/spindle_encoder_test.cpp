#include "passo/drive/spindle_encoder.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr Hertz clock_rate{1e6};

// A shaft that turns evenly, as a board would tell of it.
struct Shaft {
  double turns_per_second = 10;
  int counts = 1000;
  std::uint32_t first_count = 0;
  std::uint32_t first_tick = 0;
  double index_off = 0;  // counts, by which the index is told wrong

  SpindleCount at(double seconds) const {
    const double turns = turns_per_second * seconds;
    const double last = turns < 0 ? std::ceil(turns) : std::floor(turns);
    const auto plus = [this](double way) { return first_count + static_cast<std::uint32_t>(std::llround(way)); };
    return {.count = plus(std::floor(turns * counts)),
            .tick = first_tick + static_cast<std::uint32_t>(std::llround(seconds * clock_rate.value())),
            .at_index = plus(last * counts + (std::fmod(last, 2) == 0 ? index_off : 0)),
            .indexes = static_cast<std::uint8_t>(std::llround(std::abs(last)))};
  }
};

SpindleEncoder read_for(const Shaft& shaft, double seconds, double every = 0.004) {
  SpindleEncoder encoder(shaft.counts, clock_rate);
  for (int i = 0; i * every <= seconds; ++i) encoder.read(shaft.at(i * every));
  return encoder;
}

TEST(SpindleEncoder, puts_counts_and_ticks_together_where_they_wrap) {
  const Shaft shaft{.first_count = 0xFFFFF000, .first_tick = 0xFFFF0000};
  const SpindleEncoder encoder = read_for(shaft, 2);
  EXPECT_NEAR(encoder.now().time.value(), 2, 1e-9);
  EXPECT_NEAR(encoder.now().turns, 20, 0.0011);
  ASSERT_TRUE(encoder.index());
  EXPECT_NEAR(*encoder.index(), 20, 0.0011);
  EXPECT_FALSE(encoder.is_wrong());
}

TEST(SpindleEncoder, counts_either_way_round) {
  const SpindleEncoder encoder = read_for({.turns_per_second = -10, .first_count = 100}, 1.05);
  EXPECT_NEAR(encoder.now().turns, -10.5, 0.5);
  EXPECT_NEAR(*encoder.index(), -10, 0.0011);
  EXPECT_FALSE(encoder.is_wrong());
}

TEST(SpindleEncoder, one_index_may_be_missed) {
  // Looked at every 0.19 s, two or one come between.
  EXPECT_FALSE(read_for({}, 3, 0.19).is_wrong());
}

TEST(SpindleEncoder, indexes_that_end_no_turn_are_wrong_and_so_are_none) {
  EXPECT_TRUE(read_for({.index_off = 60}, 1).is_wrong());
  EXPECT_FALSE(read_for({.index_off = 35}, 1).is_wrong()) << "within 2 % of a turn and 2 ms";
  SpindleEncoder nearly(1000, clock_rate);  // and the encoder has 1010: within 2 % of a turn, but not in the long run
  for (int i = 0; i < 250; ++i) nearly.read(Shaft{.counts = 1010}.at(i * 0.004));
  EXPECT_TRUE(nearly.is_wrong());
  SpindleEncoder half(500, clock_rate);  // and the encoder has 730
  for (int i = 0; i < 250; ++i) half.read(Shaft{.counts = 730}.at(i * 0.004));
  EXPECT_TRUE(half.is_wrong());
  SpindleEncoder blind(1000, clock_rate);
  for (int i = 0; i < 250; ++i) {
    SpindleCount count = Shaft().at(i * 0.004);
    count.indexes = 7;
    blind.read(count);
  }
  EXPECT_TRUE(blind.is_wrong());
}

TEST(SpindleEncoder, tells_for_how_long_it_stands_though_it_trembles) {
  SpindleEncoder encoder(1000, clock_rate);
  for (std::uint32_t i = 0; i <= 100; ++i) encoder.read({.count = 5 + i % 2, .tick = i * 10'000});
  EXPECT_NEAR(encoder.stood().value(), 1, 1e-9);
  EXPECT_FALSE(encoder.is_wrong());
  encoder.read({.count = 9, .tick = 1'010'000});
  EXPECT_EQ(encoder.stood(), Seconds(0));
  encoder.restart();
  encoder.read({.count = 77, .tick = 5});
  EXPECT_EQ(encoder.now().time, Seconds(0));
  EXPECT_EQ(encoder.now().turns, 0);
}

}  // namespace
}  // namespace passo
