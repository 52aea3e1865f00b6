#include "passo/verdict/load_track.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace passo {
namespace {

double whole_time(const LoadTrack& track) {
  return std::accumulate(track.stretches().begin(), track.stretches().end(), 0.0,
                         [](double sum, const LoadTrack::Stretch& stretch) { return sum + stretch.time.value(); });
}

TEST(LoadTrack, keeps_a_short_peak_and_its_line_in_a_long_program) {
  LoadTrack track;
  for (std::uint32_t line = 1; line <= 100'000; ++line) {
    track.add(Seconds(0.01), Mm(0.1), line == 54'321 ? 1.7 : 0.2, line);
  }
  EXPECT_LE(track.stretches().size(), LoadTrack::most_stretches);
  EXPECT_GT(track.stretches().size(), LoadTrack::most_stretches / 2 - 2);
  EXPECT_NEAR(whole_time(track), 1000, 1e-6);
  const auto peak = std::ranges::max_element(track.stretches(), {}, &LoadTrack::Stretch::load);
  EXPECT_EQ(peak->load, 1.7);
  EXPECT_EQ(peak->line, 54'321U);
  const double at = static_cast<double>(peak - track.stretches().begin()) * track.length().value();
  EXPECT_NEAR(at, 543.2, track.length().value());
  EXPECT_NEAR(peak->mean_speed().value(), 10, 1e-6);
}

TEST(LoadTrack, takes_a_piece_that_lasts_for_days) {
  LoadTrack track;
  track.add(Seconds(0.5), Mm(1), 0.9, 1);
  track.add(Seconds(1e6), Mm(1e6), 0.1, 2);
  EXPECT_LE(track.stretches().size(), LoadTrack::most_stretches);
  EXPECT_NEAR(whole_time(track), 1e6 + 0.5, 1e-3);
  EXPECT_EQ(track.stretches().front().load, 0.9);
  EXPECT_EQ(track.stretches().back().line, 2U);
}

TEST(LoadTrack, of_no_motion_is_empty) {
  LoadTrack track;
  track.add(Seconds(0), Mm(0), 3, 1);
  EXPECT_TRUE(track.stretches().empty());
}

}  // namespace
}  // namespace passo
