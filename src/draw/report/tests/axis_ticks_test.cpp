#include "axis_ticks.hpp"

namespace passo {
namespace {

std::vector<std::string> labels(double low, double high, double pixels, double room) {
  std::vector<std::string> all;
  for (const Tick& tick : ticks(low, high, pixels, [room](const std::string&) { return room; })) {
    all.push_back(tick.label);
  }
  return all;
}

TEST(Ticks, are_round_numbers_with_room_for_their_labels) {
  EXPECT_THAT(labels(-12, 31, 10, 90), testing::ElementsAre("\u221210", "0", "10", "20", "30"));
  EXPECT_THAT(labels(0, 0.1, 1000, 40), testing::ElementsAre("0.00", "0.05", "0.10"));
  EXPECT_THAT(labels(0, 2e6, 3e-4, 100), testing::ElementsAre("0", "500000", "1000000", "1500000", "2000000"));
}

TEST(Ticks, stand_at_the_ends_of_a_range_in_spite_of_rounding) {
  EXPECT_THAT(labels(0.1 + 0.2 - 0.3, 0.3, 100, 10), testing::ElementsAre("0.0", "0.2"));
  EXPECT_THAT(labels(-0.3, 0.1 * 3, 100, 10), testing::ElementsAre("\u22120.2", "0.0", "0.2"));
}

TEST(Ticks, never_overlap_whatever_the_range) {
  const auto room = [](const std::string& label) { return 7.0 * static_cast<double>(label.size()) + 10; };
  for (double size = 1e-7; size < 1e9; size *= 1.7) {
    const double pixels = 600 / size;
    const auto all = ticks(-size / 3, size * 2 / 3, pixels, room);
    for (std::size_t i = 1; i < all.size(); ++i) {
      const double apart = (all[i].value - all[i - 1].value) * pixels;
      EXPECT_GE(apart, (room(all[i].label) + room(all[i - 1].label)) / 2 - 1e-6) << size;
      EXPECT_NE(all[i].label, all[i - 1].label);
    }
    EXPECT_GE(all.size(), 2U) << size;
  }
}

TEST(Ticks, of_an_empty_range_are_none) {
  EXPECT_TRUE(labels(5, 5, 10, 10).empty());
  EXPECT_TRUE(labels(5, 4, 10, 10).empty());
}

}  // namespace
}  // namespace passo
