#include "passo/sender/unacknowledged_lines.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr std::size_t told = 128;

UnacknowledgedLines window_of(std::initializer_list<const char*> lines) {
  UnacknowledgedLines window;
  std::uint32_t number = 0;
  for (const char* const text : lines) window.add({.text = text, .line = ++number});
  return window;
}

TEST(UnacknowledgedLines, sends_whole_lines_as_far_as_they_fit) {
  UnacknowledgedLines window = window_of({"G0 X1\n", "G0 X2\n", "G0 X3\n"});
  EXPECT_EQ(window.send(Seconds(1), 13), "G0 X1\nG0 X2\n");
  EXPECT_EQ(window.sent_bytes(), 12U);
  EXPECT_EQ(window.send(Seconds(1), 13), "");
  EXPECT_EQ(window.take_answered()->text, "G0 X1\n");
  EXPECT_EQ(window.send(Seconds(2), 13), "G0 X3\n");
  EXPECT_EQ(window.oldest()->line, 2U);
  EXPECT_EQ(window.oldest()->sent, Seconds(1));
  EXPECT_EQ(window.lines_sent(), 3U);
  EXPECT_EQ(window.last_line(), 3U);
}

TEST(UnacknowledgedLines, fills_a_buffer_to_its_last_byte) {
  UnacknowledgedLines window = window_of({"G0 X1\n"});
  EXPECT_EQ(window.send(Seconds(1), 5), "");
  EXPECT_EQ(window.send(Seconds(1), 6), "G0 X1\n");
}

TEST(UnacknowledgedLines, knows_an_answer_that_belongs_to_none_of_its_lines) {
  UnacknowledgedLines window = window_of({"G0 X1\n"});
  EXPECT_FALSE(window.take_answered());
  window.send(Seconds(1), told);
  EXPECT_TRUE(window.take_answered());
  EXPECT_FALSE(window.take_answered());
  EXPECT_TRUE(window.all_answered());
}

TEST(UnacknowledgedLines, uses_no_more_than_is_free_in_a_buffer_without_its_lines) {
  UnacknowledgedLines window = window_of({"G0 X1\n"});
  EXPECT_EQ(window.usable(told), told);
  window.hear_free_bytes(100);
  EXPECT_EQ(window.usable(told), 100U);
  EXPECT_EQ(window.usable(80), 80U);
  window.hear_free_bytes(20);
  EXPECT_EQ(window.usable(told), 100U);
  window.send(Seconds(1), told);
  window.hear_free_bytes(94);
  EXPECT_EQ(window.usable(told), 100U);
}

TEST(UnacknowledgedLines, remembers_answered_lines_that_the_machine_may_hold) {
  UnacknowledgedLines window = window_of({"G0 X1\n", "G0 X2\n"});
  EXPECT_EQ(window.first_held(3), 0U);
  window.send(Seconds(1), told);
  EXPECT_EQ(window.first_held(3), 2U);
  for (std::uint32_t line = 1; line <= 9; ++line) window.note_held(line, 4);
  window.note_held(0, 4);  // of no program
  EXPECT_EQ(window.first_held(2), 8U);
  EXPECT_EQ(window.first_held(99), 6U);
}

TEST(UnacknowledgedLines, may_lose_what_waits_and_what_was_sent) {
  UnacknowledgedLines window = window_of({"G0 X1\n", "G0 X2\n"});
  window.send(Seconds(1), 8);
  window.drop_waiting();
  EXPECT_EQ(window.waiting(), 0U);
  EXPECT_FALSE(window.all_answered());
  window.drop_sent();
  EXPECT_TRUE(window.all_answered());
  EXPECT_EQ(window.sent_bytes(), 0U);
}

}  // namespace
}  // namespace passo
