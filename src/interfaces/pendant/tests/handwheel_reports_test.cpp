// The reports of a handwheel at a board's pins: whole detents, and selectors that are steady.
#include "passo/pendant/handwheel_reports.hpp"

#include <random>

#include <gtest/gtest.h>

#include "passo/pendant/pendant_decoder.hpp"

namespace passo {
namespace {

using Report = std::vector<std::uint8_t>;
constexpr std::uint8_t x = handwheel_axis;

HandwheelDescription four_edges() {
  HandwheelDescription wheel;
  wheel.axes = {Axis::x, Axis::y, Axis::z, std::nullopt};
  return wheel;
}

class Turned4 {
 public:
  // Returns the detents of the report.
  int at(std::int64_t count, std::uint8_t selected = x) {
    last = reports.next({.count = static_cast<std::uint32_t>(count), .jumps = 0, .selected = selected});
    return static_cast<std::int8_t>(last[0]);
  }
  HandwheelReports reports{four_edges()};
  Report last;
};

TEST(HandwheelReports, a_detent_counts_when_all_of_its_edges_have_come) {
  Turned4 wheel;
  EXPECT_EQ(wheel.at(10), 0) << "the first reading";
  EXPECT_EQ(wheel.at(13), 0);
  EXPECT_EQ(wheel.at(14), 1);
  for (const int trembles : {13, 14, 12, 15, 11, 14}) EXPECT_EQ(wheel.at(trembles), 0) << trembles;
  EXPECT_EQ(wheel.at(10), -1);
  EXPECT_EQ(wheel.at(23), 3);
  EXPECT_EQ(wheel.at(22), 0);
  EXPECT_EQ(wheel.at(10), -3);
}

TEST(HandwheelReports, the_sum_of_detents_is_the_count_also_where_it_wraps) {
  std::mt19937 random(3);
  Turned4 wheel;
  std::int64_t count = 0x7FFFFFE0;
  EXPECT_EQ(wheel.at(count), 0);
  const std::int64_t start = count;
  std::int64_t detents = 0;
  for (int i = 0; i < 2000; ++i) {
    count += static_cast<int>(random() % 41) - 20;
    detents += wheel.at(count);
    ASSERT_LT(std::abs(count - start - 4 * detents), 4) << i;
  }
  Turned4 around;
  EXPECT_EQ(around.at(0xFFFFFFFE), 0);
  EXPECT_EQ(around.at(0x100000006), 2);
  EXPECT_EQ(around.at(0xFFFFFFFE), -2);
}

TEST(HandwheelReports, a_damaged_count_moves_nothing) {
  Turned4 wheel;
  EXPECT_EQ(wheel.at(0), 0);
  EXPECT_EQ(wheel.at(0x40000000), 0);
  EXPECT_EQ(wheel.at(8), 0);
  EXPECT_EQ(wheel.at(12), 1);
  EXPECT_EQ(wheel.at(12 + 4 * 200), 127) << "a report has room for so many";
  EXPECT_EQ(wheel.at(12 + 4 * 200), 0) << "the others are dropped";
}

TEST(HandwheelReports, a_selector_counts_when_it_was_read_twice) {
  Turned4 wheel;
  wheel.at(0);
  EXPECT_EQ(wheel.last, (Report{0, 0, 3}));
  wheel.at(0);
  EXPECT_EQ(wheel.last, (Report{0, 1, 0}));
  EXPECT_EQ(wheel.at(8, x << 1 | handwheel_hundredfold), 0) << "turned while it changes";
  EXPECT_EQ(wheel.last, (Report{0, 0, 3}));
  EXPECT_EQ(wheel.at(12, x << 1 | handwheel_hundredfold), 1);
  EXPECT_EQ(wheel.last, (Report{1, 2, 2}));
}

TEST(HandwheelReports, two_selected_axes_or_scales_are_none) {
  const PendantTable table = handwheel_table(four_edges());
  PendantDecoder decoder(table);
  Turned4 wheel;
  const auto told = [&](std::uint8_t selected) {
    wheel.at(0, selected);
    decoder.decode(wheel.last);
    wheel.at(0, selected);
    std::string words;
    for (const PendantEvent& event : decoder.decode(wheel.last)) words += describe(event, table) + "; ";
    return words;
  };
  EXPECT_EQ(told(x), "axis X; step 0.01, 50 %; ");
  EXPECT_EQ(told(x << 1 | handwheel_tenfold), "axis Y; step 0.1, 50 %; ");
  EXPECT_EQ(told(x << 2 | handwheel_hundredfold), "axis Z; step 1, 50 %; ");
  EXPECT_EQ(told(x | x << 1 | handwheel_tenfold), "axis off; step 0.1, 50 %; ");
  EXPECT_EQ(told(x | handwheel_tenfold | handwheel_hundredfold), "axis X; ");
  EXPECT_EQ(told(x << 3), "axis off; step 0.01, 50 %; ") << "a position without an axis";
}

TEST(HandwheelReports, a_reversed_wheel_turns_the_other_way) {
  HandwheelDescription description = four_edges();
  description.is_reversed = true;
  const PendantTable table = handwheel_table(description);
  PendantDecoder decoder(table);
  decoder.decode(Report{0, 1, 0});
  const auto events = decoder.decode(Report{2, 1, 0});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].number, -2);
}

}  // namespace
}  // namespace passo
