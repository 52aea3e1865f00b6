#include "passo/pendant/pendant_display.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

using Reports = std::vector<std::vector<std::uint8_t>>;

TEST(PendantDisplay, shows_place_feed_and_spindle_on_a_whb04b) {
  PendantView view{.place = {}, .feed = 1200, .spindle = 24'000};
  view.place[Axis::x] = 12.5;
  view.place[Axis::y] = -300.0625;
  view.place[Axis::z] = -0.00001;
  // 12 and 5000; 300 and 625 with the sign; 0: the sign of what rounds to zero is left out.
  EXPECT_EQ(display_reports(known_pendants()[0], view), (Reports{{6, 0xFE, 0xFD, 0xFE, 1, 12, 0, 0x88},
                                                                 {6, 0x13, 0x2C, 0x01, 0x71, 0x82, 0, 0},
                                                                 {6, 0, 0, 0xB0, 0x04, 0xC0, 0x5D, 0}}));
}

TEST(PendantDisplay, shows_the_axes_to_which_the_selected_one_belongs) {
  PendantView view{.place = {}, .is_machine_place = true, .axis = Axis::b, .is_continuous = true};
  view.place[Axis::x] = 1;
  view.place[Axis::a] = 90;
  const Reports reports = display_reports(known_pendants()[0], view);
  EXPECT_EQ(reports[0], (std::vector<std::uint8_t>{6, 0xFE, 0xFD, 0xFE, 0x80, 90, 0, 0}));
}

TEST(PendantDisplay, stays_within_its_digits) {
  PendantView view{.place = {}, .feed = 1e9, .spindle = -5};
  view.place[Axis::x] = 1e12;
  const Reports reports = display_reports(known_pendants()[0], view);
  EXPECT_EQ(reports[0][5], 0xFF);
  EXPECT_EQ(reports[2][3], 0xFF);
  EXPECT_EQ(reports[2][5], 5) << "counterclockwise";
  EXPECT_TRUE(display_reports(known_pendants()[1], view).empty()) << "it has no display";
}

}  // namespace
}  // namespace passo
