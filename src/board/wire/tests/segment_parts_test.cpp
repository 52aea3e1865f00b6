// Parts of segments: their products, and the root law against the root itself.
#include "passo/wire/segment_parts.hpp"

#include <cmath>
#include <cstdint>
#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(SegmentParts, a_product_of_halves_is_the_upper_half_of_the_whole_product) {
  std::mt19937_64 random(test::seed());
  for (int i = 0; i < 100'000; ++i) {
    const auto a = static_cast<std::int32_t>(random());
    const auto b = static_cast<std::int32_t>(random());
    const std::int64_t exact = (std::int64_t{a} * b) >> 32;
    ASSERT_NEAR(static_cast<double>(high_product(a, b)), static_cast<double>(exact), 2) << a << " " << b;
  }
}

// From 4,000 events before the rest down to 96, in one segment.
TEST(SegmentParts, a_root_brakes_evenly) {
  constexpr double rest = 4000;
  constexpr double interval = 250;  // ticks
  constexpr int part = 32;
  BoardSegment segment{.events = 3904, .form = root_form + 5, .interval = 250 << 16};
  segment.events = most_events;
  segment.change = static_cast<std::int32_t>(std::llround(part / rest * 2147483648.0));
  for (int k = 100; k <= most_events; k += 100) {
    const double exact = 2 * rest * interval * (1 - std::sqrt(1 - k / rest));
    const double played = static_cast<double>(duration(segment, k)) / 65536;
    EXPECT_NEAR(played, exact, interval) << k;
  }
}

TEST(SegmentParts, a_root_speeds_up_evenly) {
  constexpr double rest = 100;       // events behind
  constexpr double interval = 1000;  // ticks
  BoardSegment segment{.events = 1600, .form = root_form + 4, .interval = 1000 << 16};
  segment.change = -static_cast<std::int32_t>(std::llround(16 / rest * 2147483648.0));
  for (int k = 100; k <= 1600; k += 100) {
    const double exact = 2 * rest * interval * (std::sqrt(1 + k / rest) - 1);
    EXPECT_NEAR(static_cast<double>(duration(segment, k)) / 65536, exact, interval) << k;
  }
}

TEST(SegmentParts, an_even_form_has_the_same_times_in_parts_of_any_length) {
  BoardSegment segment{.events = 2000, .interval = 1000 << 16, .change = -12'345};
  const std::int64_t whole = duration(segment, 1'777);
  for (std::uint8_t form = 1; form < root_form; ++form) {
    segment.form = form;
    EXPECT_EQ(duration(segment, 1'777), whole) << unsigned{form};
  }
}

}  // namespace
}  // namespace passo
