#include "passo/activity/adaptive_feed_file.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

// The code of the first error, with its line.
std::string error_of(std::string_view text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_adaptive_feed(text, "a.csv", diagnostics));
  if (!diagnostics.any_error()) return "";
  const Diagnostic& first = diagnostics.all().front();
  return first.code + ":" + std::to_string(first.place.line);
}

TEST(AdaptiveFeedFile, each_line_is_a_time_and_a_factor) {
  Diagnostics diagnostics;
  const auto changes =
      parse_adaptive_feed("time_s,factor\r\n# a remark\n\n0,1\n 2.5 , 0.4\r\n2.5,0\n7,1e-1", "a.csv", diagnostics);
  ASSERT_TRUE(changes);
  ASSERT_EQ(changes->size(), 4);
  EXPECT_EQ(changes->at(1).at, Seconds(2.5));
  EXPECT_EQ(changes->at(1).factor, 0.4);
  EXPECT_EQ(changes->at(2).factor, 0);
  EXPECT_EQ(changes->at(3).factor, 0.1);
  EXPECT_TRUE(parse_adaptive_feed("", "a.csv", diagnostics));
}

TEST(AdaptiveFeedFile, wrong_lines_are_named) {
  for (const char* line : {"1", "1,", ",1", "1,-0.1", "1,1.01", "1,nan", "-1,1", "inf,1", "2e6,1", "1,0.5,3", "1;0.5",
                           "one,half", "0x1,1"}) {
    EXPECT_EQ(error_of(std::string("0,1\n") + line + "\n"), "adaptive-feed.bad-line:2") << line;
  }
  EXPECT_EQ(error_of("t,f\nt,f\n"), "adaptive-feed.bad-line:2");
  EXPECT_EQ(error_of("1,1\n0.5,1\n"), "adaptive-feed.bad-order:2");
}

}  // namespace
}  // namespace passo
