#include "passo/report/progress.hpp"

namespace passo {
namespace {

TEST(ProgressLine, shows_nothing_in_the_first_second) {
  ProgressLine line("part.ngc", true);
  EXPECT_EQ(line.update(0.9, Seconds(0.99)), "");
  EXPECT_EQ(line.clear(), "");
}

TEST(ProgressLine, tells_the_share_done_and_the_time_left) {
  ProgressLine line("part.ngc", true);
  EXPECT_EQ(line.update(0.25, Seconds(4)), "\r\x1b[Kpart.ngc  25 %, 12 s left");
}

TEST(ProgressLine, tells_a_time_left_that_is_known) {
  ProgressLine line("part.ngc", true);
  EXPECT_EQ(line.update(0.25, Seconds(4), {}, Seconds(70)), "\r\x1b[Kpart.ngc  25 %, 1:10 min left");
}

TEST(ProgressLine, is_narrower_than_the_terminal_also_after_the_window_was_resized) {
  ProgressLine line("a-long-name-of-a-part.ngc", true);
  std::size_t width = 80;
  const auto columns = [&] { return width; };
  EXPECT_EQ(line.update(0.25, Seconds(4), columns), "\r\x1b[Ka-long-name-of-a-part.ngc  25 %, 12 s left");
  width = 30;  // 29 characters
  EXPECT_EQ(line.update(0.25, Seconds(8), columns), "\r\x1b[Ka-long\u2026t.ngc  25 %, 24 s left");
  width = 8;
  EXPECT_EQ(line.update(0.25, Seconds(12), columns), "\r\x1b[K  25 %,");
  width = 1;
  EXPECT_EQ(line.update(0.25, Seconds(16), columns), "\r\x1b[K");
}

TEST(ProgressLine, cuts_no_character_of_a_name_in_two) {
  ProgressLine line("\u00e4\u00f6\u00fc\u00df\u00e4\u00f6\u00fc.ngc", true);
  EXPECT_EQ(line.update(0.25, Seconds(4), [] { return std::size_t{22}; }),
            "\r\x1b[K\u00e4\u00f6\u2026c  25 %, 12 s left");
}

TEST(ProgressLine, speaks_at_most_ten_times_a_second) {
  ProgressLine line("part.ngc", true);
  int spoken = 0;
  for (int i = 0; i < 3000; ++i) spoken += line.update(i / 3000.0, Seconds(i * 1e-3)).empty() ? 0 : 1;
  EXPECT_GE(spoken, 19);
  EXPECT_LE(spoken, 20);
}

TEST(ProgressLine, is_silent_where_nobody_looks_at_a_terminal) {
  ProgressLine line("part.ngc", false);
  EXPECT_EQ(line.update(0.5, Seconds(10)), "");
  EXPECT_EQ(line.clear(), "");
}

TEST(ProgressLine, does_not_say_a_hundred_percent_before_the_end_and_makes_no_early_guess) {
  ProgressLine line("part.ngc", true);
  EXPECT_EQ(line.update(0.9999, Seconds(2)), "\r\x1b[Kpart.ngc  99 %, 0 s left");
  EXPECT_EQ(line.update(0.001, Seconds(3)), "\r\x1b[Kpart.ngc   0 %");
  EXPECT_EQ(line.update(1.0, Seconds(4)), "\r\x1b[Kpart.ngc 100 %, 0 s left");
}

TEST(ProgressLine, takes_its_line_away) {
  ProgressLine line("part.ngc", true);
  EXPECT_NE(line.update(0.5, Seconds(2)), "");
  EXPECT_EQ(line.clear(), "\r\x1b[K");
  EXPECT_EQ(line.clear(), "");
}

TEST(ClockText, has_the_units_a_person_would_choose) {
  EXPECT_EQ(clock_text(Seconds(0)), "0 s");
  EXPECT_EQ(clock_text(Seconds(59.4)), "59 s");
  EXPECT_EQ(clock_text(Seconds(59.6)), "1:00 min");
  EXPECT_EQ(clock_text(Seconds(3599.6)), "1:00:00 h");
  EXPECT_EQ(clock_text(Seconds(3 * 86400)), "72:00:00 h");
}

}  // namespace
}  // namespace passo
